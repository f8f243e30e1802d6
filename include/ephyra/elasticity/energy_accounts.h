#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/record.h"
#include "ephyra/elasticity/body_measures.h"

namespace ephyra::elasticity
{
  /// Work done on a body since its start, J:
  ///   change of elastic and kinetic energy
  ///     = work of loads + of prescribed displacements + of the surroundings
  ///       + of the muscle - numerical dissipation + imbalance.
  /// The works are integrals over the steps taken, each of second order, so
  /// that the imbalance is what the steps have got wrong.
  struct EnergyAccounts
  {
    /// What a scene has; the others have no column.
    struct Parts
    {
      bool loads        = false;
      bool prescribed   = false;
      bool surroundings = false;
      bool muscle       = false;
      bool motion       = false; ///< kinetic energy
      bool dissipation  = false;
    };

    double start        = 0.; ///< elastic and kinetic energy at the start
    double loads        = 0.; ///< pressures, tractions and body forces
    double prescribed   = 0.; ///< forces that move prescribed displacements
    double surroundings = 0.; ///< load of the flow
    double muscle       = 0.; ///< power of the active strain
    double dissipation  = 0.; ///< taken out by the time integration

    double
    imbalance(const BodyMeasures &measures) const;
    /// Adds the energies, the works and the imbalance.
    void
    evaluate(const BodyMeasures &measures,
             const Parts        &parts,
             Record             &record) const;
    void
    serialize(Archive &archive);
  };
} // namespace ephyra::elasticity
