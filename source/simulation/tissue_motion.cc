#include "ephyra/simulation/tissue_motion.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/electrophysiology/line_metric.h"
#include "ephyra/splines/control_vector.h"

namespace ephyra::simulation
{
  namespace
  {
    const std::vector<std::string> variables = {"s", "r", "y", "t"};

    splines::EvaluationMatrix
    evaluation_at(const splines::NurbsPatch<1> &line,
                  const std::vector<double>    &theta)
    {
      std::vector<std::array<double, 1>> points;
      for (const double x : theta)
        points.push_back({{x}});
      return splines::EvaluationMatrix(line, points);
    }
  } // namespace

  void
  TissueMotion::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Motion");
    for (const char *direction : {"Radial", "Axial"})
      prm.declare_entry(std::string(direction) + " displacement",
                        "0",
                        patterns::Expression(variables, "m"),
                        "Prescribed displacement of the line in s = theta^1, "
                        "the reference position r, y and the time t.");
  }

  void
  TissueMotion::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Motion");
    radial = prm.get("Radial displacement");
    axial  = prm.get("Axial displacement");
  }

  TissueMotion::TissueMotion(
    const Parameters                                 &parameters,
    const splines::NurbsPatch<1>                     &line,
    const electrophysiology::ElectrophysiologySolver &solver)
    : line(line)
    , solver(solver)
    , formula{{Expression(parameters.radial, variables),
               Expression(parameters.axial, variables)}}
    , at_metric_points(evaluation_at(line, solver.metric_points()))
  {
  }

  bool
  TissueMotion::moves() const
  {
    return !formula[0].is_zero() || !formula[1].is_zero();
  }

  std::vector<double>
  TissueMotion::displacement(const double t) const
  {
    const std::vector<splines::Point> &points = line.control_points();
    std::vector<double>                result(2 * points.size(), 0.);
    for (int component = 0; component < 2; ++component)
      {
        if (formula[component].is_zero())
          continue;
        const auto values = solver.interpolate([&](const double s) {
          const splines::Point x = line.point({{s}});
          return formula[component]({s, x.r, x.y, t});
        });
        for (std::size_t i = 0; i < points.size(); ++i)
          result[2 * i + component] = values[i];
      }
    if (points.front().r == 0)
      result[0] = 0;
    if (points.back().r == 0)
      result[result.size() - 2] = 0;
    return result;
  }

  void
  TissueMotion::metric(const double         t,
                       std::vector<double> &G11,
                       std::vector<double> &r) const
  {
    std::vector<double>       position = splines::control_vector(line);
    const std::vector<double> u        = displacement(t);
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] += u[i];
    electrophysiology::line_metric(at_metric_points, position, G11, r);
    for (std::size_t q = 0; q < r.size(); ++q)
      EphyraThrowIf(!(r[q] > 0),
                    DivergedError,
                    "The prescribed motion puts the line of the tissue at r = "
                      << r[q] << " m at theta^1 = " << solver.metric_points()[q]
                      << ", t = " << t
                      << " s, where it has to be positive; change "
                         "\"Tissue/Motion\".");
  }
} // namespace ephyra::simulation
