#include "ephyra/elasticity/elasticity_parameters.h"

#include "ephyra/base/parameter_handler.h"

#include <algorithm>

namespace ephyra::elasticity
{
  void
  ElasticityParameters::declare(ParameterHandler &prm)
  {
    Material::declare(prm);
    prm.declare_entry("Density",
                      "1000 kg/m^3",
                      patterns::Positive("kg/m^3"),
                      "Density of the reference shape.");
    prm.declare_entry("Extra Gauss points",
                      "0",
                      patterns::Integer(-1, 8),
                      "Gauss points per direction and element beyond degree + "
                      "1; -1 is reduced integration.");
    prm.declare_entry("Extra Gauss points across",
                      "automatic",
                      patterns::Selection("automatic|-1|0|1|2|3|4|5|6|7|8"),
                      "The same for the direction theta^2 alone. automatic: as "
                      "\"Extra Gauss points\", but at least 2 where there is a "
                      "muscle, whose layer is thin.");
    const std::vector<std::string> variables{"r", "y", "t"};
    for (const std::string axis : {"Radial", "Axial"})
      prm.declare_entry(axis + " body force",
                        "0",
                        patterns::Expression(variables, "N/m^3"),
                        "Force per volume of the reference shape, a formula "
                        "in the reference position r, y (m) and the time t "
                        "(s).");
    prm.declare_entry("Tied sides",
                      "none",
                      patterns::Selection("none|theta1|theta2"),
                      "Ties the displacements of the two sides at the ends of "
                      "this direction to each other: a periodic body.");
    {
      ParameterHandler::Section section(prm, "Active strain");
      ActiveStrain::Parameters::declare(prm);
    }
    for (const splines::Side side : all_sides)
      {
        ParameterHandler::Section section(prm, "Side " + name(side));
        SideCondition::declare(prm);
      }
  }

  std::array<int, 2>
  ElasticityParameters::n_extra_points() const
  {
    const bool muscle = active_strain.form != ActiveStrain::Form::none;
    return {{extra_points,
             extra_points_across.value_or(muscle ? std::max(extra_points, 2)
                                                 : extra_points)}};
  }

  void
  ElasticityParameters::parse(ParameterHandler &prm)
  {
    material.parse(prm);
    density      = prm.get_double("Density");
    extra_points = prm.get_integer("Extra Gauss points");
    if (const std::string across = prm.get("Extra Gauss points across");
        across != "automatic")
      extra_points_across = std::stoi(across);
    const std::vector<std::string> variables{"r", "y", "t"};
    body_force = {{Expression(prm.get("Radial body force"), variables),
                   Expression(prm.get("Axial body force"), variables)}};
    const std::string tied = prm.get("Tied sides");
    tie                    = tied == "none"     ? Tie::none
                             : tied == "theta1" ? Tie::theta1
                                                : Tie::theta2;
    {
      ParameterHandler::Section section(prm, "Active strain");
      active_strain.parse(prm);
    }
    for (const splines::Side side : all_sides)
      {
        ParameterHandler::Section section(prm, "Side " + name(side));
        sides[static_cast<int>(side)].parse(prm);
      }
  }
} // namespace ephyra::elasticity
