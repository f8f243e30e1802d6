#include "ephyra/diagnostics/body_kinematics.h"

#include <algorithm>

namespace ephyra::diagnostics
{
  namespace
  {
    constexpr int n_samples = 200; // intervals along the outer surface
  }

  BodyKinematics::BodyKinematics(const splines::NurbsPatch<2> &patch)
    : patch(patch)
    , outer(n_samples + 1)
    , rest_radius(0.)
    , inner_rest_radius(0.)
  {
    const std::vector<double> rest(2 * patch.n_control_points(), 0.);
    patch.evaluate_basis({{1., 0.}}, inner_margin);
    for (int k = 0; k <= n_samples; ++k)
      {
        patch.evaluate_basis({{static_cast<double>(k) / n_samples, 1.}},
                             outer[k]);
        rest_radius = std::max(rest_radius, position(outer[k], rest).r);
      }
    const double inner = position(inner_margin, rest).r;
    if (inner > 1e-9 * rest_radius)
      inner_rest_radius = inner;
  }

  splines::Point
  BodyKinematics::position(const splines::BasisValues<2> &basis,
                           const std::vector<double>     &displacement) const
  {
    splines::Point result;
    for (std::size_t a = 0; a < basis.index.size(); ++a)
      {
        const int i = basis.index[a];
        result.r +=
          basis.value[a] * (patch.control_points()[i].r + displacement[2 * i]);
        result.y += basis.value[a] *
                    (patch.control_points()[i].y + displacement[2 * i + 1]);
      }
    return result;
  }

  splines::Point
  BodyKinematics::position(const std::array<double, 2> &theta,
                           const std::vector<double>   &displacement) const
  {
    splines::BasisValues<2> basis;
    patch.evaluate_basis(theta, basis);
    return position(basis, displacement);
  }

  BodyKinematics::Radii
  BodyKinematics::radii(const std::vector<double> &displacement) const
  {
    Radii result{position(outer.back(), displacement).r,
                 position(inner_margin, displacement).r,
                 0.};
    for (const splines::BasisValues<2> &basis : outer)
      result.widest = std::max(result.widest, position(basis, displacement).r);
    return result;
  }

  void
  BodyKinematics::evaluate(const std::vector<double> &displacement,
                           Record                    &record) const
  {
    double widest = 0, top = 0, bottom = 0;
    for (std::size_t k = 0; k < outer.size(); ++k)
      {
        const splines::Point x = position(outer[k], displacement);
        widest                 = std::max(widest, x.r);
        top                    = k == 0 ? x.y : std::max(top, x.y);
        bottom                 = k == 0 ? x.y : std::min(bottom, x.y);
      }
    const splines::Point margin = position(outer.back(), displacement);
    const splines::Point inner  = position(inner_margin, displacement);
    const splines::Point apex   = position(outer.front(), displacement);

    record.add("margin radius [m]", margin.r);
    record.add("inner margin radius [m]", inner.r);
    record.add("widest radius [m]", widest);
    record.add("height [m]", top - bottom);
    record.add("apex y [m]", apex.y);
    record.add("margin y [m]", margin.y);
    record.add("drop of margin diameter [-]", 1. - margin.r / rest_radius);
    record.add("drop of widest diameter [-]", 1. - widest / rest_radius);
    if (inner_rest_radius > 0.)
      record.add("drop of inner margin diameter [-]",
                 1. - inner.r / inner_rest_radius);
  }
} // namespace ephyra::diagnostics
