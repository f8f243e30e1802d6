#pragma once

#include "ephyra/base/output.h"
#include "ephyra/splines/nurbs_patch.h"

#include <string>
#include <vector>

namespace ephyra::splines
{
  /// The elements of a patch, and fields on it, as rational Bézier cells: the
  /// same functions in the basis of each element (Borden et al. 2011,
  /// 10.1002/nme.2968). With the operator C of an element, N_a = sum_b C_ab
  /// B_b, weights and coefficients are W_b = sum_a C_ab w_a and
  /// f_b = sum_a C_ab w_a f_a / W_b.
  ///
  /// Bézier points are numbered element by element, the first parametric
  /// direction fastest; elements as in PatchQuadrature.
  template <int dim>
  class BezierExtraction
  {
  public:
    explicit BezierExtraction(const NurbsPatch<dim> &patch);

    /// Bézier points of an element.
    int
    n_local() const
    {
      return static_cast<int>(local_points);
    }
    /// Bézier points of all elements.
    int
    n_points() const
    {
      return static_cast<int>(bezier_weights.size());
    }
    const std::vector<double> &
    weights() const
    {
      return bezier_weights;
    }

    /// Bézier coefficients of a field from its coefficients at the control
    /// points, components interleaved in both.
    std::vector<double>
    extract(const std::vector<double> &coefficients, int n_components) const;

    /// Points, n_local() in each element and in the order of the Bézier
    /// points, at which a function that is no spline (a stress) is sampled,
    std::vector<typename NurbsPatch<dim>::Parameter>
    sample_points() const;
    /// and the Bézier coefficients that interpolate the samples.
    std::vector<double>
    interpolate(const std::vector<double> &samples, int n_components) const;

    /// Sets the cells of an output. @p positions: r and y of the control
    /// points, m; those of the patch plus a displacement, for example.
    void
    write_cells(BezierOutput              &output,
                const std::vector<double> &positions) const;
    /// Adds a field given by its coefficients at the control points.
    void
    write_field(BezierOutput              &output,
                const std::string         &name,
                const std::vector<double> &coefficients,
                int                        n_components) const;

  private:
    NurbsPatch<dim>     patch;
    std::size_t         local_points;
    std::vector<int>    columns; ///< n_local control points of each element
    std::vector<double> entries; ///< n_local x n_local of each element
    std::vector<double> bezier_weights;
    /// Of each direction: inverse of the Bernstein values at the samples.
    std::array<std::vector<double>, dim> inverse;
  };

  extern template class BezierExtraction<1>;
  extern template class BezierExtraction<2>;
} // namespace ephyra::splines
