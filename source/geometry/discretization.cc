#include "ephyra/geometry/discretization.h"

#include "ephyra/base/exceptions.h"

#include <cmath>

namespace ephyra::geometry
{
  namespace
  {
    /// Shares n elements among spans in proportion to their sizes, at least
    /// one each; the sizes sum to one.
    std::vector<int>
    share_elements(const std::vector<double> &sizes, const int n)
    {
      std::vector<int> count(sizes.size(), 1);
      for (int left = n - static_cast<int>(sizes.size()); left > 0; --left)
        {
          // To the span with the largest elements.
          std::size_t largest = 0;
          for (std::size_t s = 1; s < sizes.size(); ++s)
            if (sizes[s] / count[s] >
                sizes[largest] / count[largest] * (1. + 1e-12))
              largest = s;
          ++count[largest];
        }
      return count;
    }
  } // namespace

  void
  check_length(const std::string &what, const double value)
  {
    EphyraThrowIf(!(value > 0.) || !std::isfinite(value),
                  InputError,
                  "The " << what << " is " << value
                         << " m; it must be positive.");
  }

  void
  Discretization::declare(ParameterHandler &prm, const int dim)
  {
    const unsigned int n = dim;
    prm.declare_entry("Degree",
                      dim == 2 ? "3, 3" : "3",
                      patterns::List(patterns::Integer(1, 15), n, n),
                      dim == 2 ? "Degree of the splines along the body "
                                 "(theta1) and across it (theta2)."
                               : "Degree of the splines along the curve.");
    prm.declare_entry("Elements",
                      dim == 2 ? "35, 6" : "35",
                      patterns::List(patterns::Integer(1), n, n),
                      dim == 2 ? "Number of elements along the body (theta1) "
                                 "and across it (theta2)."
                               : "Number of elements along the curve.");
  }

  void
  Discretization::parse(const ParameterHandler &prm, const int dim)
  {
    for (int d = 0; d < dim; ++d)
      {
        degree[d]     = std::stoi(prm.get_list("Degree")[d]);
        n_elements[d] = std::stoi(prm.get_list("Elements")[d]);
      }
  }

  template <int dim>
  splines::NurbsPatch<dim>
  refined(splines::NurbsPatch<dim> patch,
          const Discretization    &discretization,
          const std::string       &what)
  {
    for (int d = 0; d < dim; ++d)
      {
        const int degree = discretization.degree[d];
        const int n      = discretization.n_elements[d];
        const int spans  = patch.knot_vector(d).n_elements();
        EphyraThrowIf(degree < patch.degree(d),
                      InputError,
                      "The shape '" << what << "' is described exactly from "
                                    << "degree " << patch.degree(d)
                                    << " on in direction theta" << d + 1
                                    << ", but degree " << degree
                                    << " was asked for; raise it.");
        EphyraThrowIf(n < spans,
                      InputError,
                      "The shape '" << what << "' needs at least " << spans
                                    << " elements in direction theta" << d + 1
                                    << ", but " << n
                                    << " were asked for; use more.");
        patch = patch.with_elevated_degree(d, degree - patch.degree(d));

        const std::vector<double> breaks = patch.knot_vector(d).breaks();
        std::vector<double>       sizes, knots;
        for (int s = 0; s < spans; ++s)
          sizes.push_back(breaks[s + 1] - breaks[s]);
        const std::vector<int> count = share_elements(sizes, n);
        for (int s = 0; s < spans; ++s)
          for (int k = 1; k < count[s]; ++k)
            knots.push_back(breaks[s] + sizes[s] * k / count[s]);
        patch = patch.with_inserted_knots(d, knots);
      }
    return patch;
  }

  template splines::NurbsPatch<1>
  refined(splines::NurbsPatch<1>, const Discretization &, const std::string &);
  template splines::NurbsPatch<2>
  refined(splines::NurbsPatch<2>, const Discretization &, const std::string &);
} // namespace ephyra::geometry
