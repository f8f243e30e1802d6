#include "ephyra/splines/bezier_extraction.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/refinement.h"

#include <Eigen/Dense>

namespace ephyra::splines
{
  namespace
  {
    using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// C_ab of an element: the Bézier coefficients of the basis functions are
    /// polar forms with arguments from the two ends of the element.
    Matrix
    extraction_operator(const KnotVector &knots, const int element)
    {
      const int           p    = knots.degree();
      const double        from = knots.breaks()[element];
      const double        to   = knots.breaks()[element + 1];
      std::vector<double> arguments(p), rows;
      Matrix              result(p + 1, p + 1);
      for (int b = 0; b <= p; ++b)
        {
          for (int k = 0; k < p; ++k)
            arguments[k] = k < b ? to : from;
          rows.assign((p + 1) * (p + 1), 0.);
          for (int a = 0; a <= p; ++a)
            rows[a * (p + 1) + a] = 1.;
          polar_form(
            knots, knots.first_basis(element) + p, arguments, p + 1, rows);
          for (int a = 0; a <= p; ++a)
            result(a, b) = rows[p * (p + 1) + a];
        }
      return result;
    }

    /// Samples lie inside the elements, where functions of derivatives are
    /// smooth: the k-th of p + 1 at (k + 1/2) / (p + 1).
    double
    sample(const int k, const int p)
    {
      return (k + 0.5) / (p + 1);
    }

    std::vector<double>
    bernstein_inverse(const int p)
    {
      const KnotVector    knots = KnotVector::uniform(p, 1);
      std::vector<double> values(p + 1), result((p + 1) * (p + 1));
      Matrix              collocation(p + 1, p + 1);
      for (int q = 0; q <= p; ++q)
        {
          knots.evaluate(sample(q, p), 0, values.data());
          for (int b = 0; b <= p; ++b)
            collocation(q, b) = values[b];
        }
      Eigen::Map<Matrix>(result.data(), p + 1, p + 1) = collocation.inverse();
      return result;
    }
  } // namespace

  template <int dim>
  BezierExtraction<dim>::BezierExtraction(const NurbsPatch<dim> &p)
    : patch(p)
  {
    constexpr int last = dim - 1;
    const int     m0   = patch.degree(0) + 1;
    const int     m1   = dim == 2 ? patch.degree(last) + 1 : 1;
    const int     n1   = dim == 2 ? patch.n_basis(last) : 1;
    const int e1_count = dim == 2 ? patch.knot_vector(last).n_elements() : 1;
    local_points       = static_cast<std::size_t>(m0) * m1;
    for (int d = 0; d < dim; ++d)
      inverse[d] = bernstein_inverse(patch.degree(d));

    std::vector<Matrix> operators_1;
    for (int e1 = 0; e1 < e1_count; ++e1)
      operators_1.push_back(dim == 2
                              ? extraction_operator(patch.knot_vector(last), e1)
                              : Matrix::Identity(1, 1));
    for (int e0 = 0; e0 < patch.knot_vector(0).n_elements(); ++e0)
      {
        const Matrix c0     = extraction_operator(patch.knot_vector(0), e0);
        const int    first0 = patch.knot_vector(0).first_basis(e0);
        for (int e1 = 0; e1 < e1_count; ++e1)
          {
            const Matrix &c1 = operators_1[e1];
            const int     first1 =
              dim == 2 ? patch.knot_vector(last).first_basis(e1) : 0;
            const std::size_t begin = columns.size();
            for (int a0 = 0; a0 < m0; ++a0)
              for (int a1 = 0; a1 < m1; ++a1)
                columns.push_back((first0 + a0) * n1 + first1 + a1);
            for (int b1 = 0; b1 < m1; ++b1)
              for (int b0 = 0; b0 < m0; ++b0)
                {
                  double weight = 0.;
                  for (int a = 0; a < m0 * m1; ++a)
                    {
                      const double entry = c0(a / m1, b0) * c1(a % m1, b1) *
                                           patch.weights()[columns[begin + a]];
                      entries.push_back(entry);
                      weight += entry;
                    }
                  for (std::size_t a = 0; a < local_points; ++a)
                    entries[entries.size() - 1 - a] /= weight;
                  bezier_weights.push_back(weight);
                }
          }
      }
  }

  template <int dim>
  std::vector<double>
  BezierExtraction<dim>::extract(const std::vector<double> &coefficients,
                                 const int                  n_components) const
  {
    EphyraThrowIf(
      coefficients.size() !=
        static_cast<std::size_t>(patch.n_control_points()) * n_components,
      InputError,
      "A field with " << coefficients.size()
                      << " coefficients does not fit a patch of "
                      << patch.n_control_points() << " control points and "
                      << n_components << " components.");
    std::vector<double> result(bezier_weights.size() * n_components, 0.);
    for (std::size_t b = 0; b < bezier_weights.size(); ++b)
      {
        const int    *column = &columns[b / local_points * local_points];
        const double *entry  = &entries[b * local_points];
        for (std::size_t a = 0; a < local_points; ++a)
          for (int c = 0; c < n_components; ++c)
            result[b * n_components + c] +=
              entry[a] * coefficients[column[a] * n_components + c];
      }
    return result;
  }

  template <int dim>
  std::vector<typename NurbsPatch<dim>::Parameter>
  BezierExtraction<dim>::sample_points() const
  {
    std::vector<typename NurbsPatch<dim>::Parameter> points;
    std::array<int, dim>                             n{};
    for (int d = 0; d < dim; ++d)
      n[d] = patch.knot_vector(d).n_elements();
    const int m0 = patch.degree(0) + 1;
    for (int element = 0; element < patch.n_elements(); ++element)
      for (std::size_t q = 0; q < local_points; ++q)
        {
          typename NurbsPatch<dim>::Parameter theta;
          for (int d = 0; d < dim; ++d)
            {
              const int e =
                d + 1 < dim ? element / n[dim - 1] : element % n[dim - 1];
              const int   k      = static_cast<int>(d == 0 ? q % m0 : q / m0);
              const auto &breaks = patch.knot_vector(d).breaks();
              theta[d]           = breaks[e] + (breaks[e + 1] - breaks[e]) *
                                       sample(k, patch.degree(d));
            }
          points.push_back(theta);
        }
    return points;
  }

  template <int dim>
  std::vector<double>
  BezierExtraction<dim>::interpolate(const std::vector<double> &samples,
                                     const int n_components) const
  {
    EphyraThrowIf(samples.size() != bezier_weights.size() * n_components,
                  InputError,
                  "There are " << samples.size() << " samples for "
                               << bezier_weights.size() << " points and "
                               << n_components << " components.");
    // Coefficients of f = F / W with W_b constant are those of F = W f, a
    // polynomial, divided by W_b; W is evaluated through the same inverse.
    constexpr int last = dim - 1;
    const int     m0   = patch.degree(0) + 1;
    const int     m1   = dim == 2 ? patch.degree(last) + 1 : 1;
    Matrix        a    = Eigen::Map<const Matrix>(inverse[0].data(), m0, m0);
    Matrix        b    = Matrix::Identity(1, 1);
    if (dim == 2)
      b = Eigen::Map<const Matrix>(inverse[last].data(), m1, m1);
    const Matrix a_values = a.inverse(), b_values = b.inverse();

    std::vector<double> result(samples.size());
    Matrix              f(m1, m0);
    for (std::size_t begin = 0; begin < bezier_weights.size();
         begin += local_points)
      {
        const Eigen::Map<const Matrix> weights(&bezier_weights[begin], m1, m0);
        const Matrix w = b_values * weights * a_values.transpose();
        for (int c = 0; c < n_components; ++c)
          {
            for (std::size_t q = 0; q < local_points; ++q)
              f.data()[q] =
                samples[(begin + q) * n_components + c] * w.data()[q];
            const Matrix g = b * f * a.transpose();
            for (std::size_t q = 0; q < local_points; ++q)
              result[(begin + q) * n_components + c] =
                g.data()[q] / weights.data()[q];
          }
      }
    return result;
  }

  template <int dim>
  void
  BezierExtraction<dim>::write_cells(BezierOutput              &output,
                                     const std::vector<double> &positions) const
  {
    output.parametric_dimension = dim;
    for (int d = 0; d < dim; ++d)
      output.degree[d] = patch.degree(d);
    const std::vector<double> x = extract(positions, 2);
    output.r.resize(bezier_weights.size());
    output.y.resize(bezier_weights.size());
    for (std::size_t b = 0; b < bezier_weights.size(); ++b)
      {
        output.r[b] = x[2 * b];
        output.y[b] = x[2 * b + 1];
      }
    output.weight = bezier_weights;
  }

  template <int dim>
  void
  BezierExtraction<dim>::write_field(BezierOutput              &output,
                                     const std::string         &name,
                                     const std::vector<double> &coefficients,
                                     const int n_components) const
  {
    output.point_fields.push_back(
      {name, n_components, extract(coefficients, n_components)});
  }

  template class BezierExtraction<1>;
  template class BezierExtraction<2>;
} // namespace ephyra::splines
