#include "ephyra/elasticity/energy_accounts.h"

namespace ephyra::elasticity
{
  double
  EnergyAccounts::imbalance(const BodyMeasures &measures) const
  {
    return measures.elastic_energy + measures.kinetic_energy - start +
           dissipation - loads - prescribed - surroundings - muscle;
  }

  void
  EnergyAccounts::evaluate(const BodyMeasures &measures,
                           const Parts        &parts,
                           Record             &record) const
  {
    record.add("elastic energy [J]", measures.elastic_energy);
    if (parts.motion)
      record.add("kinetic energy of body [J]", measures.kinetic_energy);
    if (parts.loads)
      record.add("work of loads [J]", loads);
    if (parts.prescribed)
      record.add("work of prescribed displacements [J]", prescribed);
    if (parts.surroundings)
      record.add("work of surroundings [J]", surroundings);
    if (parts.muscle)
      record.add("muscle work [J]", muscle);
    if (parts.dissipation)
      record.add("numerical dissipation [J]", dissipation);
    record.add("energy imbalance of body [J]", imbalance(measures));
  }

  void
  EnergyAccounts::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "energy accounts");
    archive.value("start", start);
    archive.value("loads", loads);
    archive.value("prescribed displacements", prescribed);
    archive.value("surroundings", surroundings);
    archive.value("muscle", muscle);
    archive.value("dissipation", dissipation);
  }
} // namespace ephyra::elasticity
