#pragma once

#include "ephyra/base/archive.h"

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ephyra::io
{
  /// An archive in a parallel HDF5 file. Groups are HDF5 groups; values,
  /// vectors and row-distributed fields are contiguous datasets of doubles or
  /// 64-bit integers. Every dataset carries a checksum that does not depend on
  /// the distribution: a file written on some ranks is read on any number.
  ///
  /// Every function is collective, and throws the same InputError on all ranks
  /// where one of them fails: file not there, truncated, damaged, a name that
  /// it lacks, another size than the scene has.
  class Hdf5Archive : public Archive
  {
  public:
    enum class Mode
    {
      read,
      write ///< replaces a file of that name
    };

    Hdf5Archive(const std::string &file_name, Mode mode, MPI_Comm comm);
    /// Closes the file where close() was not called, as errors make happen.
    ~Hdf5Archive() override;

    /// Flushes and closes the file; throws where that fails (disk full).
    void
    close();

    /// Whether the file, read, holds a value of that name.
    bool
    contains(const std::string &name);

    bool
    reading() const override;
    void
    value(const std::string &name, double &x) override;
    void
    value(const std::string &name, std::int64_t &x) override;
    void
    values(const std::string &name, std::vector<double> &x) override;
    void
    rows(const std::string &name,
         double            *data,
         const RowLayout   &layout) override;
    /// A text, equal on all ranks.
    void
    text(const std::string &name, std::string &x);
    void
    enter(const std::string &group) override;
    void
    leave() override;

  private:
    /// Type and place of replicated data.
    struct Buffer
    {
      std::int64_t  type; ///< hid_t of one value in memory and in the file
      std::size_t   value_size;
      std::uint64_t n_values;
      void         *data;
    };
    void
    write_replicated(const std::string &name, const Buffer &buffer);
    void
    read_replicated(const std::string &name, const Buffer &buffer);
    /// Number of values of a replicated dataset in the file.
    std::uint64_t
    stored_size(const std::string &name);
    void
    write_rows(const std::string &name,
               const double      *data,
               const RowLayout   &layout);
    void
    read_rows(const std::string &name, double *data, const RowLayout &layout);

    std::string
    full_name(const std::string &name) const;
    /// The sentence of an error about this file.
    std::string
    message(const std::string &what) const;
    /// Throws on all ranks where a write @p failed on one.
    void
    check_write(bool failed, const std::string &name) const;

    const std::string        file_name;
    const Mode               mode;
    const MPI_Comm           comm;
    std::int64_t             file = -1; ///< hid_t
    std::vector<std::string> groups;
  };
} // namespace ephyra::io
