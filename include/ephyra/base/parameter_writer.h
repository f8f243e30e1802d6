#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/base/parameter_tree.h"

#include <iosfwd>

namespace ephyra
{
  /// Writes the values of a tree as a parameter file; entries that were not set
  /// are marked as defaults by a comment.
  void
  write_parameter_values(std::ostream &out, const ParameterSection &root);

  /// Writes what is declared in a tree. The text form is itself a parameter
  /// file with comments, the markdown form has one table for each subsection.
  /// A repeated subsection appears once, as "NAME of the section <name>".
  void
  write_parameter_declarations(std::ostream            &out,
                               const ParameterSection  &root,
                               ParameterHandler::Format format);
} // namespace ephyra
