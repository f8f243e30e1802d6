#include "ephyra/geometry/periodic_tie.h"

#include "ephyra/base/exceptions.h"

#include <cmath>

namespace ephyra::geometry
{
  std::vector<int>
  tied_control_points(const splines::NurbsPatch<2> &patch,
                      const splines::Side           slave,
                      const splines::Side           master)
  {
    const splines::NurbsPatch<1> a = patch.side(slave), b = patch.side(master);
    bool                         same = slave != master &&
                a.n_control_points() == b.n_control_points() &&
                a.knot_vector(0).knots() == b.knot_vector(0).knots();
    if (same)
      {
        const auto  &x = a.control_points(), &y = b.control_points();
        const double shift = x[0].y - y[0].y;
        const double size =
          std::abs(shift) +
          std::hypot(x.back().r - x.front().r, x.back().y - x.front().y);
        for (int i = 0; i < a.n_control_points(); ++i)
          same = same && std::abs(x[i].r - y[i].r) < 1e-10 * size &&
                 std::abs(x[i].y - y[i].y - shift) < 1e-10 * size &&
                 std::abs(a.weights()[i] - b.weights()[i]) < 1e-10;
      }
    EphyraThrowIf(
      !same,
      InputError,
      "Sides " << static_cast<int>(slave) << " and " << static_cast<int>(master)
               << " of a patch cannot be tied: they do not have the "
                  "same shape up to an axial shift.");
    std::vector<int> result(patch.n_control_points());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = static_cast<int>(i);
    const std::vector<int> from = patch.side_control_points(slave);
    const std::vector<int> to   = patch.side_control_points(master);
    for (std::size_t i = 0; i < from.size(); ++i)
      result[from[i]] = to[i];
    return result;
  }
} // namespace ephyra::geometry
