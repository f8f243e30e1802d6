#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ephyra
{
  /// Named numbers of one instant, in the order in which they were added; the
  /// names carry the unit ("margin radius [m]") and become column names.
  class Record
  {
  public:
    void
    add(const std::string &name, const double value)
    {
      entries.emplace_back(name, value);
    }
    const std::vector<std::pair<std::string, double>> &
    all() const
    {
      return entries;
    }

  private:
    std::vector<std::pair<std::string, double>> entries;
  };
} // namespace ephyra
