#include "ephyra/simulation/body_quantities.h"

#include "ephyra/base/exceptions.h"

#include <set>

namespace ephyra::simulation
{
  namespace
  {
    struct Entry
    {
      const char *group, *name, *file;
    };

    /// In the order of the values of evaluate_quantities().
    const Entry entries[] = {
      {"position", "r [m]", "r"},
      {"position", "y [m]", "y"},
      {"displacement", "radial displacement [m]", "radial_displacement"},
      {"displacement", "axial displacement [m]", "axial_displacement"},
      {"velocity", "radial velocity [m/s]", "radial_velocity"},
      {"velocity", "axial velocity [m/s]", "axial_velocity"},
      {"stress", "Cauchy stress rr [Pa]", "stress_rr"},
      {"stress", "Cauchy stress yy [Pa]", "stress_yy"},
      {"stress", "Cauchy stress hoop [Pa]", "stress_hoop"},
      {"stress", "Cauchy stress ry [Pa]", "stress_ry"},
      {"pressure", "pressure [Pa]", "pressure"},
      {"J", "J [-]", "J"},
      {"stretch", "stretch along theta1 [-]", "stretch_theta1"},
      {"stretch", "stretch along theta2 [-]", "stretch_theta2"},
      {"stretch", "hoop stretch [-]", "stretch_hoop"},
      {"activation", "activation [-]", "activation"}};
  } // namespace

  void
  declare_quantities(ParameterHandler &prm, const std::string &default_value)
  {
    prm.declare_entry(
      "Quantities",
      default_value,
      patterns::List(
        patterns::Selection("position|displacement|velocity|stress|pressure|J|"
                            "stretch|activation"),
        1),
      "What is written: stress is Cauchy's (rr, yy, hoop, ry), pressure minus "
      "a third of its trace, J the ratio of volumes, stretch that along "
      "theta^1, theta^2 and the hoop.");
  }

  std::vector<std::string>
  parse_quantities(ParameterHandler &prm)
  {
    const std::vector<std::string> groups = prm.get_list("Quantities");
    const std::set<std::string>    different(groups.begin(), groups.end());
    if (different.size() != groups.size())
      prm.add_error("Quantities", "one of them is named twice; name it once.");
    return groups;
  }

  std::vector<BodyQuantity>
  body_quantities(const std::vector<std::string> &groups)
  {
    std::vector<BodyQuantity> result;
    for (const std::string &group : groups)
      {
        const std::size_t before = result.size();
        int               index  = 0;
        for (const Entry &entry : entries)
          {
            if (group == entry.group)
              result.push_back({entry.name, entry.file, index});
            ++index;
          }
        EphyraThrowIf(result.size() == before,
                      InputError,
                      "A body has no quantity '" << group << "' to record.");
      }
    return result;
  }

  std::vector<double>
  evaluate_quantities(const splines::Point          &rest,
                      const splines::Point          &velocity,
                      const elasticity::PointFields &fields)
  {
    const splines::Point &u = fields.displacement;
    const auto           &s = fields.cauchy;
    return {rest.r + u.r,
            rest.y + u.y,
            u.r,
            u.y,
            velocity.r,
            velocity.y,
            s[0],
            s[3],
            s[4],
            s[1],
            -(s[0] + s[3] + s[4]) / 3.,
            fields.J,
            fields.stretch[0],
            fields.stretch[1],
            fields.stretch[2],
            fields.activation};
  }
} // namespace ephyra::simulation
