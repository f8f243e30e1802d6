#pragma once

#include "ephyra/base/parameter_handler.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <string>

namespace ephyra::geometry
{
  /// Degree and number of elements along theta^1 and across, along theta^2, to
  /// which the coarsest exact description of a shape is refined.
  struct Discretization
  {
    std::array<int, 2> degree{{3, 3}};
    std::array<int, 2> n_elements{{35, 6}};

    /// For a shape with @p dim directions.
    static void
    declare(ParameterHandler &prm, int dim);
    void
    parse(const ParameterHandler &prm, int dim);
  };

  /// Raises the degree of every direction to that asked for and cuts the spans
  /// of the patch into elements, shared among the spans in proportion to their
  /// parametric length. The geometry stays the same. Throws InputError where
  /// the degree or the number of elements is less than what the shape @p what
  /// needs.
  template <int dim>
  splines::NurbsPatch<dim>
  refined(splines::NurbsPatch<dim> patch,
          const Discretization    &discretization,
          const std::string       &what);

  /// Throws InputError unless a length is positive and finite; @p what it is.
  void
  check_length(const std::string &what, double value);
} // namespace ephyra::geometry
