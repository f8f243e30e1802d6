#pragma once

#include <string>
#include <vector>

/// Small helpers for text that users write and read.
namespace ephyra::text
{
  /// Without blanks at both ends, and with runs of blanks (spaces, tabs, line
  /// breaks, no-break spaces) inside replaced by one space.
  std::string
  normalize(const std::string &text);

  /// Items between commas, normalized; commas inside parentheses do not
  /// separate. An empty text has no items.
  std::vector<std::string>
  split_list(const std::string &text);

  /// `"text"`.
  std::string
  quote(const std::string &text);

  /// `"a", "b", "c"`.
  std::string
  quoted_list(const std::vector<std::string> &names);

  /// The shortest decimal number that reads back as @p x exactly.
  std::string
  number(double x);

  /// Number of insertions, deletions, replacements and swaps of neighbouring
  /// letters that turn one word into the other (Damerau–Levenshtein distance,
  /// restricted form); upper and lower case count as equal.
  unsigned int
  edit_distance(const std::string &a, const std::string &b);

  /// The candidate nearest to a misspelt @p name, or "" where none is close
  /// (within a third of the length of the longer word).
  std::string
  nearest(const std::string &name, const std::vector<std::string> &candidates);

  /// What to say about a misspelt @p name: `did you mean "Density"?` where a
  /// candidate is close, else `valid KIND are "A", "B"`.
  std::string
  suggestion(const std::string              &name,
             const std::vector<std::string> &candidates,
             const std::string              &kind);
} // namespace ephyra::text
