#include "ephyra/splines/patch_quadrature.h"

namespace ephyra::splines
{
  template <int dim>
  PatchQuadrature<dim>::PatchQuadrature(
    const NurbsPatch<dim>      &patch,
    const std::array<int, dim> &points_per_direction)
  {
    const int last = dim - 1;
    n_functions    = patch.degree(0) + 1;
    if (dim == 2)
      n_functions *= patch.degree(last) + 1;

    std::array<Quadrature, dim> rule;
    for (int d = 0; d < dim; ++d)
      rule[d] = gauss_legendre(points_per_direction[d]);
    const int n0        = rule[0].size();
    const int n1        = dim == 2 ? rule[last].size() : 1;
    n_quadrature_points = n0 * n1;

    const int n_elements_1 =
      dim == 2 ? patch.knot_vector(last).n_elements() : 1;
    const std::size_t n = static_cast<std::size_t>(patch.n_elements());
    indices.reserve(n * n_functions);
    table.reserve(n * n_quadrature_points * (1 + dim) * n_functions);
    weights.reserve(n * n_quadrature_points);
    parameters.reserve(n * n_quadrature_points);

    BasisValues<dim> basis;
    for (int element = 0; element < patch.n_elements(); ++element)
      for (int q = 0; q < n_quadrature_points; ++q)
        {
          const std::array<int, 2> e{
            {element / n_elements_1, element % n_elements_1}};
          const std::array<int, 2> k{{q / n1, q % n1}};
          std::array<double, dim>  theta;
          double                   weight = 1.;
          for (int d = 0; d < dim; ++d)
            {
              const std::vector<double> &breaks = patch.knot_vector(d).breaks();
              const double from = breaks[e[d]], size = breaks[e[d] + 1] - from;
              theta[d] = from + size * rule[d].points[k[d]];
              weight *= size * rule[d].weights[k[d]];
            }
          patch.evaluate_basis(theta, basis);
          if (q == 0)
            indices.insert(
              indices.end(), basis.index.begin(), basis.index.end());
          table.insert(table.end(), basis.value.begin(), basis.value.end());
          for (const std::vector<double> &derivative : basis.derivative)
            table.insert(table.end(), derivative.begin(), derivative.end());
          weights.push_back(weight);
          parameters.push_back(theta);
        }
  }

  template class PatchQuadrature<1>;
  template class PatchQuadrature<2>;
} // namespace ephyra::splines
