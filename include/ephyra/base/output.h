#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace ephyra
{
  /// One cell field on the axisymmetric flow grid, for visualisation: cell
  /// (i, j) of the rows held here is values[i * n_y + j], i along r. Vectors
  /// have their components one after another in `components`.
  struct GridField
  {
    std::string                      name; ///< with unit, e.g. "pressure [Pa]"
    std::vector<std::vector<double>> components; ///< 1: scalar; 3: x, y, z
  };

  /// The part of the flow grid that a rank holds, and the cell fields on it.
  struct GridOutput
  {
    std::vector<double>    r_faces;       ///< of all rows of the grid, m
    std::vector<double>    y_faces;       ///< m
    std::int64_t           first_row = 0; ///< first r-cell held here
    std::int64_t           n_rows    = 0;
    std::vector<GridField> fields;
  };

  /// A body as rational Bézier cells, for visualisation: exact geometry on
  /// ParaView's VTK_BEZIER_QUADRILATERAL (bodies) or VTK_BEZIER_CURVE
  /// (surfaces). Held by the first rank.
  struct BezierField
  {
    std::string         name; ///< with unit
    int                 n_components = 1;
    std::vector<double> values; ///< per Bézier point, components interleaved
  };
  struct BezierOutput
  {
    std::string        name; ///< of the body, part of the file name
    int                parametric_dimension = 2;
    std::array<int, 2> degree{{1, 1}};
    /// Bézier control points of all cells, one cell after another, each
    /// lexicographic with the first parametric direction fastest; r and y in
    /// m, and the rational weight.
    std::vector<double>      r, y, weight;
    std::vector<BezierField> point_fields;
  };

  /// Loose points in the half plane, for visualisation. Held by the first rank.
  struct PointOutput
  {
    struct Field
    {
      std::string         name; ///< with unit
      std::vector<double> values;
    };
    std::vector<double> r, y; ///< m
    std::vector<Field>  fields;
  };
} // namespace ephyra
