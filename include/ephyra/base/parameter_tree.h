#pragma once

#include "ephyra/base/patterns.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ephyra
{
  class ParameterHandler;

  /// One declared entry and its value.
  struct ParameterEntry
  {
    std::string                            name;
    std::string                            default_value;
    std::string                            value;
    std::unique_ptr<patterns::PatternBase> pattern;
    std::string                            documentation;
    std::string origin;       ///< "file:line" or "--set", "" for the default
    int         file_id = -1; ///< which reading of a file has set it

    /// Also where a file sets it to the default, as resolved files do.
    bool
    is_default() const
    {
      return origin.empty() || value == pattern->resolve(default_value, "");
    }
  };

  /// A subsection that a file may repeat with instance names of its choice.
  struct RepeatedSection
  {
    std::string                             name;
    std::function<void(ParameterHandler &)> declare;
    std::string                             documentation;
  };

  /// A subsection: what is declared in it, in the order of declaration, and the
  /// instances of repeated subsections that a file has opened.
  struct ParameterSection
  {
    std::string             name;
    const ParameterSection *parent = nullptr;
    std::string instance_of; ///< name of the repeated section, "" for others
    std::vector<std::unique_ptr<ParameterEntry>>   entries;
    std::vector<std::unique_ptr<ParameterSection>> subsections;
    std::vector<RepeatedSection>                   repeated;

    /// nullptr where there is none.
    ParameterEntry *
    find_entry(const std::string &entry) const;
    ParameterSection *
    find_subsection(const std::string &subsection) const;

    ParameterSection &
    add_subsection(const std::string &subsection);

    std::vector<std::string>
    entry_names() const;

    /// "Section/Subsection", with '/' and @p entry appended where given.
    std::string
    path(const std::string &entry = "") const;
  };
} // namespace ephyra
