#pragma once

#include "ephyra/base/archive.h"

#include <cstddef>
#include <string>
#include <vector>

namespace ephyra
{
  /// An archive in memory: what makes coupling iterations and step cut-backs
  /// safe. Values are kept in the order in which they were written, so the
  /// names cost nothing; memory is kept between uses.
  ///   memory.begin_writing(); solver.serialize(memory);   // save
  ///   memory.begin_reading(); solver.serialize(memory);   // restore
  class MemoryArchive : public Archive
  {
  public:
    /// @p for_repeated_step: see Archive::repeats_step().
    explicit MemoryArchive(bool for_repeated_step = false);

    void
    begin_writing();
    /// Throws where nothing was written before.
    void
    begin_reading();
    bool
    empty() const;

    bool
    reading() const override;
    bool
    repeats_step() const override;
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
    void
    enter(const std::string &group) override;
    void
    leave() override;

  private:
    void
    transfer(void *data, std::size_t n_bytes);

    const bool                 for_repeated_step;
    std::vector<unsigned char> buffer;
    std::size_t                position   = 0;
    bool                       is_reading = false;
  };
} // namespace ephyra
