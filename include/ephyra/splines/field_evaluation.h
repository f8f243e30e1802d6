#pragma once

#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <vector>

namespace ephyra::splines
{
  /// Evaluation of fields of a patch at a list of points as a sparse matrix:
  /// rows are points, columns are control points; values and first parametric
  /// derivatives. Made once, used for markers, probes and the transfer between
  /// patches: u(theta_p) = sum_i R_i(theta_p) u_i.
  ///
  /// Vectors have their components interleaved: x[i * n_components + c].
  class EvaluationMatrix
  {
  public:
    EvaluationMatrix() = default;

    template <int dim>
    EvaluationMatrix(
      const NurbsPatch<dim>                                  &patch,
      const std::vector<typename NurbsPatch<dim>::Parameter> &points);

    /// Points on a side of a patch; columns are the control points of the
    /// whole patch, the one derivative is that along the side.
    static EvaluationMatrix
    on_side(const NurbsPatch<2>       &patch,
            Side                       side,
            const std::vector<double> &points);

    /// Adds the rows of another matrix of the same columns and directions
    /// below those of this one (to an empty one: any).
    void
    append(const EvaluationMatrix &other);

    int
    n_points() const
    {
      return static_cast<int>(row_start.size()) - 1;
    }
    int
    n_control_points() const
    {
      return n_columns;
    }
    /// Parametric directions with derivatives.
    int
    n_directions() const
    {
      return static_cast<int>(derivative.size());
    }

    /// y_p = sum_i R_i(theta_p) x_i; y is resized.
    void
    apply(const std::vector<double> &x,
          std::vector<double>       &y,
          int                        n_components) const;
    /// y_p = sum_i dR_i/dtheta^(direction+1) (theta_p) x_i.
    void
    apply_derivative(int                        direction,
                     const std::vector<double> &x,
                     std::vector<double>       &y,
                     int                        n_components) const;
    /// x_i += sum_p R_i(theta_p) y_p: what point loads do to control points.
    void
    apply_transposed_add(const std::vector<double> &y,
                         std::vector<double>       &x,
                         int                        n_components) const;

    // Rows in compressed form, for those who need the entries themselves:
    // entries of point p are [first_entry(p), first_entry(p + 1)).
    int
    first_entry(const int point) const
    {
      return row_start[point];
    }
    const std::vector<int> &
    columns() const
    {
      return column;
    }
    const std::vector<double> &
    values() const
    {
      return value;
    }
    const std::vector<double> &
    derivatives(const int direction) const
    {
      return derivative[direction];
    }

  private:
    void
    multiply(const std::vector<double> &entries,
             const std::vector<double> &x,
             std::vector<double>       &y,
             int                        n_components) const;

    int                              n_columns = 0;
    std::vector<int>                 row_start{0};
    std::vector<int>                 column;
    std::vector<double>              value;
    std::vector<std::vector<double>> derivative;
  };
} // namespace ephyra::splines
