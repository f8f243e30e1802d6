#pragma once

#include "ephyra/geometry/body_patch.h"

#include <string>

namespace ephyra::geometry
{
  /// A patch as written in a text file:
  ///
  ///   # anything behind a hash is a comment
  ///   dimension 2            1: a curve, 2: the section of a body
  ///   unit mm                of the control points: m, cm or mm
  ///   degree 2 1             in each direction
  ///   knots 0 0 0 1 1 1      one line for each direction
  ///   knots 0 0 1 1
  ///   dry theta1_1           optional: sides that are no surface of the body
  ///   reversed               optional, of a curve: the body is to the right
  ///   closed                 optional, of a curve
  ///   control_points         then one line "r y weight" for each; the second
  ///   0 10 1                 direction is the fastest
  ///   ...
  ///
  /// Errors are InputErrors that name file and line.
  struct PatchFile
  {
    int                              dimension = 0;
    std::vector<splines::KnotVector> knot_vectors;
    std::vector<Point>               points; ///< m
    std::vector<double>              weights;
    std::vector<Side>                dry;
    bool                             reversed = false;
    bool                             closed   = false;
  };

  PatchFile
  read_patch_file(const std::string &file_name);
} // namespace ephyra::geometry
