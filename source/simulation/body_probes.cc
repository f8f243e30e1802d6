#include "ephyra/simulation/body_probes.h"

namespace ephyra::simulation
{
  void
  BodyProbe::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Point",
                      "0, 0",
                      patterns::List(patterns::Double("", 0., 1.), 2, 2),
                      "theta^1, theta^2 of a material point that is followed.");
  }

  std::vector<BodyProbe>
  BodyProbe::parse_all(ParameterHandler &prm)
  {
    std::vector<BodyProbe> result;
    for (const std::string &name : prm.instances("Body probe"))
      {
        const ParameterHandler::Section section(prm, "Body probe " + name);
        const auto                      point = prm.get_double_list("Point");
        if (point.size() == 2)
          result.push_back({name, {{point[0], point[1]}}});
      }
    return result;
  }

  BodyProbes::BodyProbes(const std::vector<BodyProbe> &probes,
                         const splines::NurbsPatch<2> &patch)
  {
    for (const BodyProbe &probe : probes)
      {
        Point point;
        point.name = probe.name;
        point.rest = patch.point(probe.theta);
        patch.evaluate_basis(probe.theta, point.basis);
        points.push_back(point);
      }
  }

  void
  BodyProbes::write(const double               time,
                    const std::vector<double> &displacement,
                    const std::vector<double> &velocity,
                    RunOutput                 &output) const
  {
    for (const Point &point : points)
      {
        std::array<double, 2> u{{0., 0.}}, v{{0., 0.}};
        for (std::size_t a = 0; a < point.basis.index.size(); ++a)
          for (int c = 0; c < 2; ++c)
            {
              const int i = 2 * point.basis.index[a] + c;
              u[c] += point.basis.value[a] * displacement[i];
              v[c] += point.basis.value[a] * velocity[i];
            }
        Record record;
        record.add("r [m]", point.rest.r + u[0]);
        record.add("y [m]", point.rest.y + u[1]);
        record.add("radial displacement [m]", u[0]);
        record.add("axial displacement [m]", u[1]);
        record.add("radial velocity [m/s]", v[0]);
        record.add("axial velocity [m/s]", v[1]);
        output.add_row("probes/" + point.name, time, record);
      }
  }
} // namespace ephyra::simulation
