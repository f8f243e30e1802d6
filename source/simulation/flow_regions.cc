#include "ephyra/simulation/flow_regions.h"

namespace ephyra::simulation
{
  namespace
  {
    void
    declare_region(ParameterHandler &prm)
    {
      const std::string limits = "; empty: as far as the grid reaches.";
      prm.declare_entry("Radial limits",
                        "",
                        patterns::List(patterns::Double("m"), 0, 2),
                        "Smallest and largest r" + limits);
      prm.declare_entry("Axial limits",
                        "",
                        patterns::List(patterns::Double("m"), 0, 2),
                        "Smallest and largest y" + limits);
      prm.declare_entry(
        "Vorticity flux",
        "",
        patterns::List(patterns::Selection("lower|upper|outer")),
        "Sides of the region through which the flux of "
        "vorticity, positive into the region, is recorded.");
      prm.declare_entry("Vortex ring",
                        "none",
                        patterns::Selection("none|positive|negative"),
                        "Record the vortex ring of this sign around the "
                        "strongest vorticity in the region.");
      prm.declare_entry("Ring level",
                        "0.1",
                        patterns::Double("", 1e-6, 1.),
                        "The ring reaches to where the vorticity has fallen to "
                        "this share of the strongest.");
    }

    /// Two increasing numbers, or none.
    void
    parse_limits(ParameterHandler  &prm,
                 const std::string &entry,
                 double            &smallest,
                 double            &largest)
    {
      const std::vector<double> limits = prm.get_double_list(entry);
      if (limits.empty())
        return;
      if (limits.size() != 2 || limits[0] >= limits[1])
        {
          prm.add_error(
            entry, "it needs two numbers, the smaller one first, or none.");
          return;
        }
      smallest = limits[0];
      largest  = limits[1];
    }

    fluid::Side
    to_side(const std::string &name)
    {
      return name == "lower"   ? fluid::Side::lower
             : name == "upper" ? fluid::Side::upper
                               : fluid::Side::outer;
    }

    std::string
    to_string(const fluid::Side side)
    {
      return side == fluid::Side::lower   ? "lower"
             : side == fluid::Side::upper ? "upper"
                                          : "outer";
    }
  } // namespace

  void
  FlowRegion::declare(ParameterHandler &prm)
  {
    prm.declare_repeated_subsection(
      "Flow region",
      declare_region,
      "A rectangle of the half plane whose circulation, vortex impulse and, on "
      "demand, vorticity flux and vortex ring are among the statistics.");
  }

  std::vector<FlowRegion>
  FlowRegion::parse_all(ParameterHandler &prm)
  {
    std::vector<FlowRegion> result;
    for (const std::string &name : prm.instances("Flow region"))
      {
        const ParameterHandler::Section section(prm, "Flow region " + name);
        FlowRegion                      region;
        region.name = name;
        parse_limits(
          prm, "Radial limits", region.limits.r_min, region.limits.r_max);
        parse_limits(
          prm, "Axial limits", region.limits.y_min, region.limits.y_max);
        for (const std::string &side : prm.get_list("Vorticity flux"))
          region.flux_sides.push_back(to_side(side));
        const std::string ring = prm.get("Vortex ring");
        region.ring       = ring == "positive" ? fluid::VorticitySign::positive
                            : ring == "negative" ? fluid::VorticitySign::negative
                                                 : fluid::VorticitySign::all;
        region.ring_level = prm.get_double("Ring level");
        result.push_back(region);
      }
    return result;
  }

  void
  FlowRegion::evaluate(const fluid::FlowSolver &flow, Record &record) const
  {
    const fluid::VorticityIntegrals integrals =
      fluid::vorticity_integrals(flow.velocity(), flow.density(), limits);
    const auto add = [&](const std::string &what, const double value) {
      record.add(name + " " + what, value);
    };
    add("circulation [m^2/s]", integrals.circulation());
    add("positive circulation [m^2/s]", integrals.positive);
    add("negative circulation [m^2/s]", integrals.negative);
    add("vortex impulse [kg m/s]", integrals.impulse);
    for (const fluid::Side side : flux_sides)
      {
        const fluid::VorticityFlux flux =
          fluid::vorticity_flux(flow.velocity(), limits, side);
        add("vorticity flux " + to_string(side) + " [m^2/s^2]", flux.total);
        add("shear vorticity flux " + to_string(side) + " [m^2/s^2]",
            flux.shear);
      }
    if (ring == fluid::VorticitySign::all)
      return;
    const fluid::VortexRing found = fluid::find_vortex_ring(
      flow.velocity(), flow.density(), limits, ring, ring_level);
    add("ring circulation [m^2/s]", found.circulation);
    add("ring impulse [kg m/s]", found.impulse);
    add("ring r [m]", found.r);
    add("ring y [m]", found.y);
    add("ring speed [m/s]", found.speed);
    add("ring peak vorticity [1/s]", found.peak);
  }
} // namespace ephyra::simulation
