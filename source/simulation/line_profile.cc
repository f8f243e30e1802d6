#include "ephyra/simulation/line_profile.h"

#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    constexpr int n_intervals = 100;

    std::vector<double>
    equal_parameters()
    {
      std::vector<double> result;
      for (int k = 0; k <= n_intervals; ++k)
        result.push_back(static_cast<double>(k) / n_intervals);
      return result;
    }

    std::vector<std::string>
    column_names(const std::vector<double> &points)
    {
      std::vector<std::string> result;
      for (const double theta : points)
        {
          std::ostringstream name;
          name << theta;
          result.push_back(name.str());
        }
      return result;
    }
  } // namespace

  LineProfile::LineProfile(const splines::NurbsPatch<1> &line)
    : points(equal_parameters())
    , names(column_names(points))
  {
    std::vector<std::array<double, 1>> parameters;
    for (const double theta : points)
      parameters.push_back({{theta}});
    evaluation = splines::EvaluationMatrix(line, parameters);
  }

  LineProfile::LineProfile(const splines::NurbsPatch<2> &patch,
                           const splines::Side           side)
    : points(equal_parameters())
    , names(column_names(points))
    , evaluation(splines::EvaluationMatrix::on_side(patch, side, points))
  {
  }

  void
  LineProfile::write(const std::string         &name,
                     const double               time,
                     const std::vector<double> &coefficients,
                     const int                  n_components,
                     const int                  component,
                     RunOutput                 &output) const
  {
    std::vector<double> values, row;
    evaluation.apply(coefficients, values, n_components);
    for (std::size_t k = 0; k < points.size(); ++k)
      row.push_back(values[k * n_components + component]);
    output.add_profile(name, time, names, row);
  }

  void
  LineProfile::write(const std::string                   &name,
                     const double                         time,
                     const std::function<double(double)> &function,
                     RunOutput                           &output)
  {
    const std::vector<double> points = equal_parameters();
    std::vector<double>       row;
    for (const double theta : points)
      row.push_back(function(theta));
    output.add_profile(name, time, column_names(points), row);
  }
} // namespace ephyra::simulation
