#include "ephyra/geometry/bell.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/splines/quadrature.h"

#include <array>
#include <cmath>

namespace ephyra::geometry
{
  namespace
  {
    /// A control point in homogeneous coordinates, for one column of the net.
    struct WeightedPoint
    {
      Point  x;
      double weight;
    };

    double
    quarter_ellipse_length(const double a, const double b)
    {
      const splines::Quadrature rule = splines::gauss_legendre(60);
      const double              end  = std::acos(0.);
      double                    sum  = 0.;
      for (int q = 0; q < rule.size(); ++q)
        sum += rule.weights[q] * end *
               std::hypot(a * std::cos(end * rule.points[q]),
                          b * std::sin(end * rule.points[q]));
      return sum;
    }

    /// The three control points of a quarter ellipse from (0, b) to (a, 0).
    /// The weights (1, s cos 45, s^2) describe the same curve for any s; with
    /// s^2 = b/a it starts as fast as it ends. All are then scaled so that the
    /// last is one.
    std::array<WeightedPoint, 3>
    quarter_ellipse(const double a, const double b, const double center)
    {
      const double s = std::sqrt(b / a);
      return {{{{0., center + b}, 1. / (s * s)},
               {{a, center + b}, std::sqrt(0.5) / s},
               {{a, center}, 1.}}};
    }

    /// The control point between an inner and an outer one that makes the map
    /// across the body linear where their weights differ.
    WeightedPoint
    between(const WeightedPoint &inner, const WeightedPoint &outer)
    {
      const double sum = inner.weight + outer.weight;
      const double w_i = outer.weight / sum, w_o = inner.weight / sum;
      return {
        {w_i * inner.x.r + w_o * outer.x.r, w_i * inner.x.y + w_o * outer.x.y},
        sum / 2.};
    }
  } // namespace

  void
  BellParameters::declare(ParameterHandler &prm)
  {
    const auto declare_ratio = [&prm](const std::string &name,
                                      const std::string &value,
                                      const std::string &text) {
      prm.declare_entry(name,
                        value,
                        patterns::Positive(),
                        text + ", as a fraction of the radius.");
    };
    prm.declare_entry("Radius",
                      "15 mm",
                      patterns::Positive("m"),
                      "Radial half axis of the exumbrellar ellipse: half the "
                      "diameter of the bell.");
    declare_ratio(
      "Outer height", "0.8", "Vertical half axis of the exumbrellar ellipse");
    declare_ratio(
      "Inner radius", "0.948", "Radial half axis of the subumbrellar ellipse");
    declare_ratio(
      "Inner height", "0.46", "Vertical half axis of the subumbrellar ellipse");
    declare_ratio("Flap length", "0.14", "Length of the marginal flap");
    declare_ratio(
      "Margin radius", "0.036", "Radius of the arc that closes the margin");
  }

  void
  BellParameters::parse(const ParameterHandler &prm)
  {
    radius        = prm.get_double("Radius");
    outer_height  = prm.get_double("Outer height");
    inner_radius  = prm.get_double("Inner radius");
    inner_height  = prm.get_double("Inner height");
    flap_length   = prm.get_double("Flap length");
    margin_radius = prm.get_double("Margin radius");
  }

  void
  BellParameters::check() const
  {
    for (const auto &[name, value] :
         {std::pair("radius", radius),
          std::pair("outer height", outer_height),
          std::pair("inner radius", inner_radius),
          std::pair("inner height", inner_height),
          std::pair("flap length", flap_length),
          std::pair("margin radius", margin_radius)})
      EphyraThrowIf(!(value > 0.) || !std::isfinite(value),
                    InputError,
                    "The " << name << " of the bell is " << value
                           << "; it must be positive.");
    EphyraThrowIf(inner_radius >= 1. || inner_height >= outer_height,
                  InputError,
                  "The inner ellipse of the bell (half axes "
                    << inner_radius << " and " << inner_height
                    << " of the radius) is not inside the outer one (1 and "
                    << outer_height << "); make it smaller.");
    const double half_chord = (1. - inner_radius) / 2.;
    EphyraThrowIf(margin_radius < 1.02 * half_chord,
                  InputError,
                  "The margin radius of the bell, "
                    << margin_radius << " of the radius, is too small for the "
                    << "thickness of the flap; it must be at least "
                    << 1.02 * half_chord << ".");
  }

  double
  BellParameters::joint() const
  {
    const double length = quarter_ellipse_length(inner_radius, inner_height);
    return length / (length + flap_length);
  }

  BodyPatch
  make_bell(const BellParameters &parameters,
            const double          apex,
            const Discretization &discretization)
  {
    parameters.check();
    const double a_ex   = parameters.radius,
                 b_ex   = parameters.outer_height * a_ex;
    const double a_in   = parameters.inner_radius * a_ex;
    const double b_in   = parameters.inner_height * a_ex;
    const double center = apex - b_ex;
    const double margin = center - parameters.flap_length * a_ex;
    const double cosine =
      std::sqrt(1. - std::pow((1. - parameters.inner_radius) / 2. /
                                parameters.margin_radius,
                              2));
    const double sagitta_of_tangents =
      (a_ex - a_in) / 2. * std::sqrt(1. - cosine * cosine) / cosine;

    const auto inner = quarter_ellipse(a_in, b_in, center);
    const auto outer = quarter_ellipse(a_ex, b_ex, center);
    // Columns of the net: three of the ellipses, then the flap, whose middle
    // one follows from raising its degree to two.
    std::vector<WeightedPoint> net;
    for (int i = 0; i < 3; ++i)
      net.insert(net.end(), {inner[i], between(inner[i], outer[i]), outer[i]});
    const double        middle = (a_in + a_ex) / 2.;
    const WeightedPoint tip{{middle, margin - sagitta_of_tangents}, cosine};
    const WeightedPoint half_way{
      {middle, (center + cosine * tip.x.y) / (1. + cosine)},
      (1. + cosine) / 2.};
    net.insert(net.end(),
               {{{a_in, (center + margin) / 2.}, 1.},
                half_way,
                {{a_ex, (center + margin) / 2.}, 1.},
                {{a_in, margin}, 1.},
                tip,
                {{a_ex, margin}, 1.}});

    std::vector<Point>  points;
    std::vector<double> weights;
    for (const WeightedPoint &p : net)
      {
        points.push_back(p.x);
        weights.push_back(p.weight);
      }
    const double        joint = parameters.joint();
    const NurbsPatch<2> patch(
      {splines::KnotVector(2, {0., 0., 0., joint, joint, 1., 1., 1.}),
       splines::KnotVector::uniform(2, 1)},
      std::move(points),
      std::move(weights));
    return make_body("bell", refined(patch, discretization, "bell"));
  }

  BodyCurve
  make_subumbrella(const double          a,
                   const double          b,
                   const double          flap,
                   const double          center,
                   const Discretization &discretization)
  {
    check_length("radial half axis of the subumbrella", a);
    check_length("axial half axis of the subumbrella", b);
    check_length("flap of the subumbrella", flap);
    std::vector<Point>  points;
    std::vector<double> weights;
    for (const WeightedPoint &p : quarter_ellipse(a, b, center))
      {
        points.push_back(p.x);
        weights.push_back(p.weight);
      }
    for (const double part : {0.5, 1.})
      {
        points.push_back({a, center - part * flap});
        weights.push_back(1.);
      }
    const double        length = quarter_ellipse_length(a, b);
    const double        joint  = length / (length + flap);
    const NurbsPatch<1> line(
      {splines::KnotVector(2, {0., 0., 0., joint, joint, 1., 1., 1.})},
      std::move(points),
      std::move(weights));
    return {
      "subumbrella", refined(line, discretization, "subumbrella"), true, false};
  }
} // namespace ephyra::geometry
