#pragma once

#include <string>
#include <vector>

namespace ephyra
{
  /// One statement of a parameter file, comments removed and continued lines
  /// joined.
  struct ParameterStatement
  {
    enum class Kind
    {
      subsection, ///< name
      set,        ///< name, value
      end,
      include, ///< name: the file
      invalid  ///< value: what is wrong with the line
    };
    Kind        kind;
    int         line; ///< first line of the statement, from 1
    std::string name;
    std::string value;
  };

  /// Splits the text of a parameter file into statements; knows the syntax and
  /// nothing of what is declared. Never throws: what cannot be understood
  /// becomes an `invalid` statement.
  std::vector<ParameterStatement>
  parse_parameter_text(const std::string &text);
} // namespace ephyra
