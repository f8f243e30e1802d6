#include "ephyra/electrophysiology/line_metric.h"

namespace ephyra::electrophysiology
{
  void
  line_metric(const splines::EvaluationMatrix &at,
              const std::vector<double>       &position,
              std::vector<double>             &G11,
              std::vector<double>             &r)
  {
    std::vector<double> x, tangent;
    at.apply(position, x, 2);
    at.apply_derivative(0, position, tangent, 2);
    const std::size_t n = x.size() / 2;
    G11.resize(n);
    r.resize(n);
    for (std::size_t q = 0; q < n; ++q)
      {
        G11[q] = tangent[2 * q] * tangent[2 * q] +
                 tangent[2 * q + 1] * tangent[2 * q + 1];
        r[q] = x[2 * q];
      }
  }
} // namespace ephyra::electrophysiology
