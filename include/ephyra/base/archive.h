#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ephyra
{
  /// A two-dimensional field of which every rank holds some full rows.
  struct RowLayout
  {
    std::int64_t n_global_rows; ///< rows over all ranks
    std::int64_t first_row;     ///< global index of the first row held here
    std::int64_t n_rows;        ///< rows held here (may be 0)
    std::int64_t n_columns;     ///< values in a row that count
    std::int64_t row_stride;    ///< distance of two rows in memory, in values
  };

  /// What a solver writes its state to and reads it from. Every solver has one
  /// function `serialize(Archive &)` that names all it needs to continue; the
  /// same function serves checkpoints (HDF5, see io/checkpoint.h) and
  /// save_state()/restore_state() (memory, see base/memory_archive.h), so no
  /// field can be forgotten in one of them.
  ///
  /// Replicated values must be equal on all ranks; the writer takes those of
  /// the first. All functions are collective. Names are unique within their
  /// group and may hold '/'.
  class Archive
  {
  public:
    virtual ~Archive() = default;

    /// True where values are read, false where they are written.
    virtual bool
    reading() const = 0;
    /// True where the state only serves to repeat the step that follows: a
    /// solver may leave out what it can take back by itself.
    virtual bool
    repeats_step() const
    {
      return false;
    }

    virtual void
    value(const std::string &name, double &x) = 0;
    virtual void
    value(const std::string &name, std::int64_t &x) = 0;
    /// Resized when read.
    virtual void
    values(const std::string &name, std::vector<double> &x) = 0;
    /// A distributed field. When read, the layout may differ from the one it
    /// was written with (another number of ranks), the global size may not.
    virtual void
    rows(const std::string &name, double *data, const RowLayout &layout) = 0;

    /// Opens and closes a group of names.
    virtual void
    enter(const std::string &group) = 0;
    virtual void
    leave() = 0;

    /// Keeps a group open for a scope.
    class Group
    {
    public:
      Group(Archive &archive, const std::string &name)
        : archive(archive)
      {
        archive.enter(name);
      }
      ~Group()
      {
        archive.leave();
      }
      Group(const Group &) = delete;
      Group &
      operator=(const Group &) = delete;

    private:
      Archive &archive;
    };
  };
} // namespace ephyra
