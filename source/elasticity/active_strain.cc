#include "ephyra/elasticity/active_strain.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <algorithm>
#include <cmath>

namespace ephyra::elasticity
{
  namespace
  {
    /// Contravariant vectors g^1, g^2 of the section.
    std::pair<splines::Point, splines::Point>
    contravariant(const ReferenceFrame &frame)
    {
      const auto  &a = frame.g1, &b = frame.g2;
      const double d = 1. / (a.r * b.y - a.y * b.r);
      return {{d * b.y, -d * b.r}, {-d * a.y, d * a.r}};
    }

    double
    norm_square(const splines::Point &p)
    {
      return p.r * p.r + p.y * p.y;
    }
  } // namespace

  void
  ActiveStrain::Parameters::declare(ParameterHandler &prm)
  {
    const patterns::Double fraction("", 0.);
    prm.declare_entry("Form",
                      "unit directors",
                      patterns::Selection("none|unit directors|paper metric"),
                      "Directors of the active strain: unit directors make a1 "
                      "and a3 true shortening fractions; the paper metric "
                      "takes eqs. (25)-(27) literally, with lengths in the "
                      "unit \"Metric length\".");
    prm.declare_entry("Radial amplitude",
                      "0",
                      fraction,
                      "Amplitude a1 of radial muscles, eq. (28).");
    prm.declare_entry("Coronal amplitude",
                      "0.096",
                      fraction,
                      "Amplitude a3 of coronal muscles, eq. (29).");
    prm.declare_entry("Metric length",
                      "30 mm",
                      patterns::Positive("m"),
                      "Unit of length L of the paper metric: the hoop "
                      "shortening is a3 L^2/r^2.");
    prm.declare_entry("Axis cut",
                      "0.1, 0.25",
                      patterns::List(patterns::Double("", 0., 1.), 2, 2),
                      "The pattern of the paper metric is multiplied by a "
                      "smooth step from 0 to 1 between these values of "
                      "theta1; equal values switch this off.");
    prm.declare_entry("Steepness along",
                      "10",
                      patterns::Positive(),
                      "w1 of the muscle pattern, eq. (30).");
    prm.declare_entry("Steepness across",
                      "40",
                      patterns::Positive(),
                      "w2 of the muscle pattern, eq. (30).");
    prm.declare_entry("Start along",
                      "0.55",
                      patterns::Double(),
                      "delta1 of the muscle pattern, eq. (30).");
    prm.declare_entry("Depth across",
                      "0.2",
                      patterns::Double(),
                      "delta2 of the muscle pattern, eq. (30).");
    prm.declare_entry("Pattern",
                      "eq. 30",
                      patterns::Anything(),
                      "\"eq. 30\", or a formula in theta1, theta2 that "
                      "replaces it.");
  }

  void
  ActiveStrain::Parameters::parse(ParameterHandler &prm)
  {
    const std::string name        = prm.get("Form");
    form                          = name == "none"             ? Form::none
                                    : name == "unit directors" ? Form::unit_directors
                                                               : Form::paper_metric;
    a1                            = prm.get_double("Radial amplitude");
    a3                            = prm.get_double("Coronal amplitude");
    length                        = prm.get_double("Metric length");
    const std::vector<double> cut = prm.get_double_list("Axis cut");
    cut_start                     = cut[0];
    cut_end                       = cut[1];
    if (cut_end < cut_start)
      prm.add_error("Axis cut", "ends before it starts; give start, end");
    w1     = prm.get_double("Steepness along");
    w2     = prm.get_double("Steepness across");
    delta1 = prm.get_double("Start along");
    delta2 = prm.get_double("Depth across");
    pattern.reset();
    if (const std::string formula = prm.get("Pattern"); formula != "eq. 30")
      try
        {
          pattern.emplace(formula,
                          std::vector<std::string>{"theta1", "theta2"});
        }
      catch (const InputError &error)
        {
          prm.add_error("Pattern", error.what());
        }
  }

  ActiveStrain::ActiveStrain(const Parameters &parameters)
    : prm(parameters)
  {
  }

  double
  ActiveStrain::pattern(const double theta1, const double theta2) const
  {
    double value = prm.pattern
                     ? (*prm.pattern)({theta1, theta2})
                     : 0.25 * (1. - std::tanh(prm.w2 * (theta2 - prm.delta2))) *
                         (1. - std::tanh(prm.w1 * (prm.delta1 - theta1)));
    if (prm.form == Form::paper_metric && prm.cut_end > 0.)
      {
        const double width = prm.cut_end - prm.cut_start;
        const double x =
          width > 0. ? std::clamp((theta1 - prm.cut_start) / width, 0., 1.)
                     : 1.;
        value *= x * x * (3. - 2. * x);
      }
    return value;
  }

  double
  ActiveStrain::shortening(const ReferenceFrame &frame,
                           const double          activity) const
  {
    if (prm.form == Form::none)
      return 0.;
    if (prm.form == Form::unit_directors)
      return activity * std::max(prm.a1, prm.a3);
    const double L2 = prm.length * prm.length;
    return activity * L2 *
           std::max(prm.a1 * norm_square(contravariant(frame).first),
                    prm.a3 / (frame.r * frame.r));
  }

  AxisymmetricTensor
  ActiveStrain::deformation(const ReferenceFrame &frame,
                            const double          activity) const
  {
    if (prm.form == Form::none || activity == 0.)
      return {1., 0., 0., 1., 1.};

    if (prm.form == Form::unit_directors)
      {
        const double s1 = 1. - activity * prm.a1;
        const double s3 = 1. - activity * prm.a3;
        const double s2 = 1. / (s1 * s3);
        const double g  = 1. / std::sqrt(norm_square(frame.g1));
        const double fr = g * frame.g1.r, fy = g * frame.g1.y;
        const double ry = (s1 - s2) * fr * fy;
        return {
          s1 * fr * fr + s2 * fy * fy, ry, ry, s1 * fy * fy + s2 * fr * fr, s3};
      }

    const double L2     = prm.length * prm.length;
    const auto [g1, g2] = contravariant(frame);
    const double s1     = activity * prm.a1 * L2;
    const double hoop   = 1. - activity * prm.a3 * L2 / (frame.r * frame.r);
    // In the section B + gamma_2 g^2 g^2, whose determinant is
    // det B + gamma_2 g^2 . adj(B) g^2 and has to be 1/hoop.
    const double rr = 1. - s1 * g1.r * g1.r;
    const double ry = -s1 * g1.r * g1.y;
    const double yy = 1. - s1 * g1.y * g1.y;
    const double gamma2 =
      (1. / hoop - (rr * yy - ry * ry)) /
      (yy * g2.r * g2.r - 2. * ry * g2.r * g2.y + rr * g2.y * g2.y);
    return {rr + gamma2 * g2.r * g2.r,
            ry + gamma2 * g2.r * g2.y,
            ry + gamma2 * g2.r * g2.y,
            yy + gamma2 * g2.y * g2.y,
            hoop};
  }

  AxisymmetricTensor
  inverse(const AxisymmetricTensor &T)
  {
    const double d = 1. / (T[0] * T[3] - T[1] * T[2]);
    return {d * T[3], -d * T[1], -d * T[2], d * T[0], 1. / T[4]};
  }
} // namespace ephyra::elasticity
