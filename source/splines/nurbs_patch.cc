#include "ephyra/splines/nurbs_patch.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/refinement.h"

#include <cmath>

namespace ephyra::splines
{
  namespace
  {
    constexpr int max_values = 3 * (KnotVector::max_degree + 1);

    /// The control net as lines of homogeneous coordinates across a direction.
    template <int dim>
    SplineRows
    to_rows(const NurbsPatch<dim> &patch, const int direction)
    {
      const int  n = patch.n_basis(direction);
      const int  m = patch.n_control_points() / n;
      SplineRows result{patch.knot_vector(direction), {}, 3 * m};
      result.rows.reserve(3 * static_cast<std::size_t>(n) * m);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j)
          {
            const int    c = direction == 0 ? i * m + j : j * n + i;
            const double w = patch.weights()[c];
            const Point &x = patch.control_points()[c];
            result.rows.insert(result.rows.end(), {w * x.r, w * x.y, w});
          }
      return result;
    }

    template <int dim>
    NurbsPatch<dim>
    from_rows(const NurbsPatch<dim> &old,
              const SplineRows      &spline,
              const int              direction)
    {
      const int           n = spline.knots.n_basis();
      const int           m = spline.width / 3;
      std::vector<Point>  points(static_cast<std::size_t>(n) * m);
      std::vector<double> weights(points.size());
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j)
          {
            const double *x =
              &spline.rows[3 * (static_cast<std::size_t>(i) * m + j)];
            const int c = direction == 0 ? i * m + j : j * n + i;
            points[c]   = {x[0] / x[2], x[1] / x[2]};
            weights[c]  = x[2];
          }
      std::vector<KnotVector> knot_vectors;
      for (int d = 0; d < dim; ++d)
        knot_vectors.push_back(d == direction ? spline.knots
                                              : old.knot_vector(d));
      return NurbsPatch<dim>(
        std::move(knot_vectors), std::move(points), std::move(weights));
    }
  } // namespace

  template <int dim>
  NurbsPatch<dim>::NurbsPatch(std::vector<KnotVector> knot_vectors,
                              std::vector<Point>      control_points,
                              std::vector<double>     weights)
    : kv(std::move(knot_vectors))
    , points(std::move(control_points))
    , w(std::move(weights))
  {
    EphyraThrowIf(kv.size() != dim,
                  InputError,
                  "A patch of dimension " << dim << " was given " << kv.size()
                                          << " knot vectors.");
    std::size_t n = 1;
    for (const KnotVector &k : kv)
      n *= k.n_basis();
    EphyraThrowIf(points.size() != n || w.size() != n,
                  InputError,
                  "The knot vectors of a patch ask for "
                    << n << " control points, but there are " << points.size()
                    << " points and " << w.size() << " weights.");
    for (std::size_t i = 0; i < n; ++i)
      {
        EphyraThrowIf(!(w[i] > 0.) || !std::isfinite(w[i]),
                      InputError,
                      "The weight of control point "
                        << i << " is " << w[i] << "; weights are positive.");
        EphyraThrowIf(
          !std::isfinite(points[i].r) || !std::isfinite(points[i].y),
          InputError,
          "Control point " << i << " is not finite: (" << points[i].r << ", "
                           << points[i].y << ").");
      }
  }

  template <int dim>
  int
  NurbsPatch<dim>::n_elements() const
  {
    int n = 1;
    for (const KnotVector &k : kv)
      n *= k.n_elements();
    return n;
  }

  template <int dim>
  void
  NurbsPatch<dim>::evaluate_basis(const std::array<double, dim> &theta,
                                  BasisValues<dim>              &out,
                                  const bool second_derivatives) const
  {
    std::array<std::array<double, max_values>, dim> b;
    std::array<int, dim>                            first;
    const int order = second_derivatives ? 2 : 1;
    for (int d = 0; d < dim; ++d)
      first[d] = kv[d].evaluate(theta[d], order, b[d].data());

    const int m0 = degree(0) + 1;
    const int m1 = dim == 2 ? degree(dim - 1) + 1 : 1;
    const int n1 = dim == 2 ? n_basis(dim - 1) : 1;
    const int n  = m0 * m1;
    out.index.resize(n);
    out.value.resize(n);
    for (auto &values : out.derivative)
      values.resize(n);
    for (auto &values : out.second)
      values.resize(second_derivatives ? n : 0);

    // Weighted products A_a = N_a w_a and their derivatives, and the sums W.
    double                               sum = 0.;
    std::array<double, dim>              sum_1{};
    std::array<double, dim == 1 ? 1 : 3> sum_2{};
    for (int a0 = 0; a0 < m0; ++a0)
      for (int a1 = 0; a1 < m1; ++a1)
        {
          const int a = a0 * m1 + a1;
          const int c =
            (first[0] + a0) * n1 + (dim == 2 ? first[dim - 1] + a1 : 0);
          out.index[a]        = c;
          const double weight = w[c];
          if constexpr (dim == 1)
            {
              out.value[a]         = weight * b[0][a0];
              out.derivative[0][a] = weight * b[0][m0 + a0];
              if (second_derivatives)
                out.second[0][a] = weight * b[0][2 * m0 + a0];
            }
          else
            {
              out.value[a]         = weight * b[0][a0] * b[1][a1];
              out.derivative[0][a] = weight * b[0][m0 + a0] * b[1][a1];
              out.derivative[1][a] = weight * b[0][a0] * b[1][m1 + a1];
              if (second_derivatives)
                {
                  out.second[0][a] = weight * b[0][2 * m0 + a0] * b[1][a1];
                  out.second[1][a] = weight * b[0][a0] * b[1][2 * m1 + a1];
                  out.second[2][a] = weight * b[0][m0 + a0] * b[1][m1 + a1];
                }
            }
          sum += out.value[a];
          for (int d = 0; d < dim; ++d)
            sum_1[d] += out.derivative[d][a];
          if (second_derivatives)
            for (std::size_t s = 0; s < sum_2.size(); ++s)
              sum_2[s] += out.second[s][a];
        }

    // Quotient rule: R = A/W, R' = (A' - W' R)/W,
    // R_kl = (A_kl - W_k R_l - W_l R_k - W_kl R)/W.
    const double inverse = 1. / sum;
    for (int a = 0; a < n; ++a)
      {
        out.value[a] *= inverse;
        for (int d = 0; d < dim; ++d)
          out.derivative[d][a] =
            (out.derivative[d][a] - sum_1[d] * out.value[a]) * inverse;
        if (second_derivatives)
          for (std::size_t s = 0; s < sum_2.size(); ++s)
            {
              const int k = s == 1 ? 1 : 0;
              const int l = s == 0 ? 0 : dim - 1;
              out.second[s][a] =
                (out.second[s][a] - sum_1[k] * out.derivative[l][a] -
                 sum_1[l] * out.derivative[k][a] - sum_2[s] * out.value[a]) *
                inverse;
            }
      }
  }

  template <int dim>
  Point
  NurbsPatch<dim>::point(const std::array<double, dim> &theta) const
  {
    BasisValues<dim> basis;
    evaluate_basis(theta, basis);
    Point x;
    for (std::size_t a = 0; a < basis.index.size(); ++a)
      {
        x.r += basis.value[a] * points[basis.index[a]].r;
        x.y += basis.value[a] * points[basis.index[a]].y;
      }
    return x;
  }

  template <int dim>
  std::array<Point, dim>
  NurbsPatch<dim>::tangents(const std::array<double, dim> &theta) const
  {
    BasisValues<dim> basis;
    evaluate_basis(theta, basis);
    std::array<Point, dim> g;
    for (int d = 0; d < dim; ++d)
      for (std::size_t a = 0; a < basis.index.size(); ++a)
        {
          g[d].r += basis.derivative[d][a] * points[basis.index[a]].r;
          g[d].y += basis.derivative[d][a] * points[basis.index[a]].y;
        }
    return g;
  }

  template <int dim>
  std::vector<int>
  NurbsPatch<dim>::side_control_points(const Side s) const
  {
    static_assert(dim == 1 || dim == 2);
    std::vector<int> result;
    if constexpr (dim == 2)
      {
        const int  n0 = n_basis(0), n1 = n_basis(1);
        const bool last = s == Side::theta1_1 || s == Side::theta2_1;
        if (s == Side::theta1_0 || s == Side::theta1_1)
          for (int j = 0; j < n1; ++j)
            result.push_back((last ? n0 - 1 : 0) * n1 + j);
        else
          for (int i = 0; i < n0; ++i)
            result.push_back(i * n1 + (last ? n1 - 1 : 0));
      }
    else
      {
        EphyraThrowIf(s != Side::theta1_0 && s != Side::theta1_1,
                      InputError,
                      "A curve has only the sides theta1 = 0 and theta1 = 1.");
        result.push_back(s == Side::theta1_0 ? 0 : n_basis(0) - 1);
      }
    return result;
  }

  template <int dim>
  NurbsPatch<1>
  NurbsPatch<dim>::side(const Side s) const
  {
    EphyraThrowIf(dim == 1, InputError, "A curve has no sides of its own.");
    const bool          across = s == Side::theta1_0 || s == Side::theta1_1;
    std::vector<Point>  side_points;
    std::vector<double> side_weights;
    for (const int c : side_control_points(s))
      {
        side_points.push_back(points[c]);
        side_weights.push_back(w[c]);
      }
    return NurbsPatch<1>({kv[across ? dim - 1 : 0]},
                         std::move(side_points),
                         std::move(side_weights));
  }

  template <int dim>
  NurbsPatch<dim>
  NurbsPatch<dim>::with_inserted_knots(
    const int direction, const std::vector<double> &new_knots) const
  {
    return from_rows(
      *this, insert_knots(to_rows(*this, direction), new_knots), direction);
  }

  template <int dim>
  NurbsPatch<dim>
  NurbsPatch<dim>::with_elevated_degree(const int direction,
                                        const int times) const
  {
    return from_rows(
      *this, elevate_degree(to_rows(*this, direction), times), direction);
  }

  template <int dim>
  NurbsPatch<dim>
  NurbsPatch<dim>::with_split_elements(const int direction,
                                       const int n_parts) const
  {
    return with_inserted_knots(direction,
                               splitting_knots(kv[direction], n_parts));
  }

  template class NurbsPatch<1>;
  template class NurbsPatch<2>;
} // namespace ephyra::splines
