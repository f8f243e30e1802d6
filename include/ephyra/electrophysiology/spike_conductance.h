#pragma once

#include "ephyra/electrophysiology/ionic_model.h"

namespace ephyra::electrophysiology
{
  /// Largest conductance over capacitance, -df/dv, 1/s, in the spike of an
  /// isolated cell after one EPSC of the default synapses, with reflux.
  ///
  /// It limits the explicit step: with Crank-Nicolson for diffusion and the
  /// second-order Adams-Bashforth method for f = -g v a wave of the number k
  /// is multiplied by z with
  ///
  ///   (1 + d) z^2 - (1 - d) z + g dt (3 z - 1)/2 = 0,   d = kappa k^2 dt/2,
  ///
  /// and z = -1 solves it for g dt = 1 whatever d is: the limit 1/g does not
  /// depend on the mesh.
  double
  spike_conductance(const IonicModel &model, double cell_capacitance);
} // namespace ephyra::electrophysiology
