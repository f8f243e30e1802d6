#pragma once

#include "ephyra/base/output.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace ephyra::io
{
  /// Writes the cell fields of the flow as a VTK rectilinear grid: one piece
  /// `stem_RANK.vtr` for each rank that holds rows, and `stem.pvtr`, which
  /// lists them. x is r and y is y, both in m; fields are float32, zlib
  /// compressed. Collective; throws InputError where a file cannot be written.
  void
  write_flow(const std::string &stem, const GridOutput &output, MPI_Comm comm);

  /// Writes a body as rational Bézier cells to `stem.vtu`: its geometry is
  /// exact (ParaView draws it so from Nonlinear Subdivision Level 2 on), with
  /// the point array RationalWeights and the cell array HigherOrderDegrees.
  /// Written by the first rank; collective; throws InputError.
  void
  write_body(const std::string  &stem,
             const BezierOutput &output,
             MPI_Comm            comm);

  /// Writes points and their fields, all as float64, to `stem.vtp`. Written by
  /// the first rank; collective; throws InputError.
  void
  write_points(const std::string &stem,
               const PointOutput &output,
               MPI_Comm           comm);

  /// The order in which VTK wants the (p+1)(q+1) points of a Bézier
  /// quadrilateral (corners, edges, interior; p+1 points of a curve where
  /// @p parametric_dimension is 1): entry k is the lexicographic index, first
  /// direction fastest, of VTK's point k.
  std::vector<int>
  vtk_bezier_order(int parametric_dimension, const std::array<int, 2> &degree);
} // namespace ephyra::io
