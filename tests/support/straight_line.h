#pragma once

#include "ephyra/splines/nurbs_patch.h"

/// A straight line with the given degree and number of equal elements.
inline ephyra::splines::NurbsPatch<1>
straight_line(const ephyra::splines::Point &from,
              const ephyra::splines::Point &to,
              const int                     degree,
              const int                     n_elements)
{
  ephyra::splines::NurbsPatch<1> line(
    {ephyra::splines::KnotVector::uniform(1, 1)}, {from, to}, {1., 1.});
  if (degree > 1)
    line = line.with_elevated_degree(0, degree - 1);
  return line.with_split_elements(0, n_elements);
}
