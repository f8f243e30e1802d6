#include "ephyra/coupling/fixed_point.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ephyra::coupling
{
  namespace
  {
    double
    norm(const std::vector<double> &x)
    {
      double sum = 0;
      for (const double value : x)
        sum += value * value;
      return std::sqrt(sum);
    }
  } // namespace

  FixedPoint::FixedPoint(fluid::FlowSolver        &flow,
                         DeformableBody           &body,
                         WetSurface               &surface,
                         const CouplingParameters &parameters)
    : FluidStructureScheme(flow, body, surface)
    , parameters(parameters)
    , acceleration(make_acceleration(parameters.acceleration))
    , older_load(body.n_unknowns(), 0.)
  {
    EphyraThrowIf(flow.n_stages() != 1,
                  InputError,
                  "Coupling/Scheme = fixed point needs a flow with one "
                  "projection a step; set Fluid/Time scheme = "
                  "ab2 or use Scheme = sequential.");
  }

  StepStatus
  FixedPoint::answer(const double               t,
                     const double               dt,
                     const std::vector<double> &x,
                     std::vector<double>       &result)
  {
    elasticity::InterfaceLoad interface_load;
    interface_load.constant = x;
    StepStatus status       = body.advance_mechanics(t, dt, interface_load);
    if (!status.success)
      return status;
    flow.reset_to_predicted(0);
    surface.set_motion(body.motion());
    surface.solve_forcing();
    status = force_and_project(0);
    if (!status.success)
      return status;
    result.assign(body.n_unknowns(), 0.);
    surface.fluid_load(flow, dt, result);
    return status;
  }

  StepStatus
  FixedPoint::advance(const double t, const double dt)
  {
    StepStatus status = prepare(t, dt);
    if (!status.success)
      return status;

    acceleration->start_step();
    // Loads that strain the body by less than this are below what its Newton
    // iteration resolves.
    constexpr double smallest_strain = 1e-11;
    const double     floor =
      std::max(parameters.absolute_tolerance,
               smallest_strain * body.mechanics().body().unit_force());
    std::vector<double> x(load), result; // linear prediction
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += load[i] - older_load[i];

    for (int k = 1; k <= parameters.maximum_iterations; ++k)
      {
        status = answer(t, dt, x, result);
        if (!status.success)
          break;
        double change = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
          change += std::pow(result[i] - x[i], 2);
        change            = std::sqrt(change);
        const double size = norm(result);
        if (!std::isfinite(change))
          {
            status = StepStatus::failure(
              "The load of the fluid on the body is not finite in coupling "
              "iteration " +
              std::to_string(k) + ".");
            break;
          }
        status.iterations = k;
        status.residual   = size > 0 ? change / size : 0.;
        relaxation        = acceleration->relaxation();
        if (change <= parameters.tolerance * size + floor)
          {
            acceleration->finish_step(true);
            older_load = load;
            accept(result);
            last = status;
            return status;
          }
        x = acceleration->next(x, result);
      }

    acceleration->finish_step(false);
    if (status.success)
      {
        std::ostringstream reason;
        reason << "The coupling did not converge in "
               << parameters.maximum_iterations
               << " iterations: relative residual " << status.residual
               << ", tolerance " << parameters.tolerance
               << ". Take smaller steps, more iterations or a looser tolerance "
                  "(section Coupling).";
        status = StepStatus::failure(reason.str());
      }
    return status;
  }

  void
  FixedPoint::serialize(Archive &archive)
  {
    FluidStructureScheme::serialize(archive);
    archive.values("older load", older_load);
    const Archive::Group group(archive, "acceleration");
    acceleration->serialize(archive);
  }
} // namespace ephyra::coupling
