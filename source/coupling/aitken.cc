#include "ephyra/coupling/aitken.h"

#include <algorithm>
#include <cmath>

namespace ephyra::coupling
{
  Aitken::Aitken(const Parameters &parameters, const bool dynamic)
    : parameters(parameters)
    , dynamic(dynamic)
    , omega(parameters.initial_relaxation)
  {
  }

  void
  Aitken::start_step()
  {
    old_residual.clear();
  }

  std::vector<double>
  Aitken::next(const std::vector<double> &x, const std::vector<double> &answer)
  {
    const std::size_t   n = x.size();
    std::vector<double> residual(n);
    for (std::size_t i = 0; i < n; ++i)
      residual[i] = answer[i] - x[i];

    if (dynamic && !old_residual.empty())
      {
        double product = 0, square = 0;
        for (std::size_t i = 0; i < n; ++i)
          {
            const double change = residual[i] - old_residual[i];
            product += old_residual[i] * change;
            square += change * change;
          }
        if (square > 0)
          omega *= -product / square;
        const double size = std::clamp(std::abs(omega),
                                       1e-3 * parameters.initial_relaxation,
                                       parameters.largest_relaxation);
        omega             = omega < 0 ? -size : size;
      }
    old_residual = residual;

    std::vector<double> result(n);
    for (std::size_t i = 0; i < n; ++i)
      result[i] = x[i] + omega * residual[i];
    return result;
  }

  void
  Aitken::finish_step(const bool)
  {
    // The next step starts from the last factor, within sensible bounds.
    omega = dynamic ? std::clamp(std::abs(omega),
                                 0.1 * parameters.initial_relaxation,
                                 parameters.largest_relaxation)
                    : parameters.initial_relaxation;
  }

  double
  Aitken::relaxation() const
  {
    return omega;
  }

  void
  Aitken::serialize(Archive &archive)
  {
    archive.value("relaxation", omega);
  }
} // namespace ephyra::coupling
