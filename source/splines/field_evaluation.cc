#include "ephyra/splines/field_evaluation.h"

#include "ephyra/base/exceptions.h"

namespace ephyra::splines
{
  template <int dim>
  EvaluationMatrix::EvaluationMatrix(
    const NurbsPatch<dim>                                  &patch,
    const std::vector<typename NurbsPatch<dim>::Parameter> &points)
    : n_columns(patch.n_control_points())
    , derivative(dim)
  {
    BasisValues<dim> basis;
    for (const auto &theta : points)
      {
        patch.evaluate_basis(theta, basis);
        for (std::size_t a = 0; a < basis.index.size(); ++a)
          {
            bool needed = basis.value[a] != 0.;
            for (int d = 0; d < dim; ++d)
              needed = needed || basis.derivative[d][a] != 0.;
            if (!needed)
              continue;
            column.push_back(basis.index[a]);
            value.push_back(basis.value[a]);
            for (int d = 0; d < dim; ++d)
              derivative[d].push_back(basis.derivative[d][a]);
          }
        row_start.push_back(static_cast<int>(column.size()));
      }
  }

  EvaluationMatrix
  EvaluationMatrix::on_side(const NurbsPatch<2>       &patch,
                            const Side                 side,
                            const std::vector<double> &points)
  {
    std::vector<std::array<double, 1>> parameters;
    for (const double theta : points)
      parameters.push_back({{theta}});
    EvaluationMatrix       result(patch.side(side), parameters);
    const std::vector<int> of_patch = patch.side_control_points(side);
    for (int &c : result.column)
      c = of_patch[c];
    result.n_columns = patch.n_control_points();
    return result;
  }

  void
  EvaluationMatrix::append(const EvaluationMatrix &other)
  {
    if (n_points() == 0)
      {
        *this = other;
        return;
      }
    EphyraThrowIf(other.n_columns != n_columns ||
                    other.derivative.size() != derivative.size(),
                  InputError,
                  "Evaluation matrices of "
                    << n_columns << " and " << other.n_columns
                    << " control points cannot be joined.");
    const int shift = row_start.back();
    for (int p = 0; p < other.n_points(); ++p)
      row_start.push_back(shift + other.row_start[p + 1]);
    column.insert(column.end(), other.column.begin(), other.column.end());
    value.insert(value.end(), other.value.begin(), other.value.end());
    for (std::size_t d = 0; d < derivative.size(); ++d)
      derivative[d].insert(derivative[d].end(),
                           other.derivative[d].begin(),
                           other.derivative[d].end());
  }

  void
  EvaluationMatrix::multiply(const std::vector<double> &entries,
                             const std::vector<double> &x,
                             std::vector<double>       &y,
                             const int                  n_components) const
  {
    EphyraAssert(x.size() == static_cast<std::size_t>(n_columns) * n_components,
                 "coefficients do not fit the patch");
    y.resize(static_cast<std::size_t>(n_points()) * n_components);
    for (int p = 0; p < n_points(); ++p)
      for (int c = 0; c < n_components; ++c)
        {
          double sum = 0.;
          for (int k = row_start[p]; k < row_start[p + 1]; ++k)
            sum += entries[k] * x[column[k] * n_components + c];
          y[p * n_components + c] = sum;
        }
  }

  void
  EvaluationMatrix::apply(const std::vector<double> &x,
                          std::vector<double>       &y,
                          const int                  n_components) const
  {
    multiply(value, x, y, n_components);
  }

  void
  EvaluationMatrix::apply_derivative(const int                  direction,
                                     const std::vector<double> &x,
                                     std::vector<double>       &y,
                                     const int n_components) const
  {
    multiply(derivative[direction], x, y, n_components);
  }

  void
  EvaluationMatrix::apply_transposed_add(const std::vector<double> &y,
                                         std::vector<double>       &x,
                                         const int n_components) const
  {
    EphyraAssert(x.size() == static_cast<std::size_t>(n_columns) * n_components,
                 "coefficients do not fit the patch");
    for (int p = 0; p < n_points(); ++p)
      for (int k = row_start[p]; k < row_start[p + 1]; ++k)
        for (int c = 0; c < n_components; ++c)
          x[column[k] * n_components + c] += value[k] * y[p * n_components + c];
  }

  template EvaluationMatrix::EvaluationMatrix(
    const NurbsPatch<1> &, const std::vector<std::array<double, 1>> &);
  template EvaluationMatrix::EvaluationMatrix(
    const NurbsPatch<2> &, const std::vector<std::array<double, 2>> &);
} // namespace ephyra::splines
