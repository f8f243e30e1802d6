#include "ephyra/base/parameter_tree.h"

namespace ephyra
{
  ParameterEntry *
  ParameterSection::find_entry(const std::string &entry) const
  {
    for (const auto &candidate : entries)
      if (candidate->name == entry)
        return candidate.get();
    return nullptr;
  }

  ParameterSection *
  ParameterSection::find_subsection(const std::string &subsection) const
  {
    for (const auto &candidate : subsections)
      if (candidate->name == subsection)
        return candidate.get();
    return nullptr;
  }

  ParameterSection &
  ParameterSection::add_subsection(const std::string &subsection)
  {
    subsections.push_back(std::make_unique<ParameterSection>());
    subsections.back()->name   = subsection;
    subsections.back()->parent = this;
    return *subsections.back();
  }

  std::vector<std::string>
  ParameterSection::entry_names() const
  {
    std::vector<std::string> names;
    for (const auto &entry : entries)
      names.push_back(entry->name);
    return names;
  }

  std::string
  ParameterSection::path(const std::string &entry) const
  {
    const std::string above  = parent == nullptr ? "" : parent->path();
    std::string       result = above + (above.empty() ? "" : "/") + name;
    if (!entry.empty())
      result += (result.empty() ? "" : "/") + entry;
    return result;
  }
} // namespace ephyra
