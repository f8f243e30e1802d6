#include "ephyra/coupling/nerve_net.h"

#include "ephyra/base/log.h"
#include "ephyra/base/timer_tree.h"
#include "ephyra/electrophysiology/line_metric.h"
#include "ephyra/splines/control_vector.h"

#include <algorithm>

namespace ephyra::coupling
{
  namespace
  {
    std::vector<std::array<double, 1>>
    as_parameters(const std::vector<double> &theta)
    {
      std::vector<std::array<double, 1>> result;
      result.reserve(theta.size());
      for (const double t : theta)
        result.push_back({{t}});
      return result;
    }
  } // namespace

  NerveNet::NerveNet(
    const electrophysiology::ElectrophysiologySolver::Parameters &parameters,
    const splines::NurbsPatch<2>                                 &patch,
    const int                                                     n_nested,
    const std::vector<double> &activation_points,
    const MPI_Comm             comm)
    : nested(patch, splines::Side::theta2_0, n_nested, patch.degree(0))
    , solver(parameters, nested.patch(), comm)
    , line_of_patch(nested.parent_field(solver.metric_points()))
    , to_mechanics(nested.patch(), as_parameters(activation_points))
  {
    reference = splines::control_vector(patch);
    sample_activation(0.);
    log().line("Nerve net: " + std::to_string(solver.n_control_points()) +
               " control points");
  }

  StepStatus
  NerveNet::advance(const double               t,
                    const double               dt,
                    const std::vector<double> &displacement)
  {
    const TimerTree::Scope scope(
      timer(), "electrophysiology", solver.n_control_points());
    position = reference;
    for (std::size_t i = 0; i < position.size(); ++i)
      position[i] += displacement[i];
    electrophysiology::line_metric(line_of_patch, position, G11, r);
    solver.set_deformed_metric(G11, r);
    const StepStatus status = solver.advance(t, dt);
    if (status.success)
      sample_activation(t + dt);
    return status;
  }

  void
  NerveNet::sample_activation(const double t)
  {
    solver.activation(t, coefficients);
    to_mechanics.apply(coefficients, gamma, 1);
    // A spline may overshoot its coefficients' range by round-off only; the
    // replay itself may pass the nominal peak of one by a little.
    for (double &value : gamma)
      value = std::max(value, 0.);
  }

  void
  NerveNet::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "nerve net");
    solver.serialize(archive);
    archive.values("activation", gamma);
  }

  void
  NerveNet::evaluate(Record &record) const
  {
    const auto &v = solver.potential();
    record.add("largest potential [V]", *std::max_element(v.begin(), v.end()));
    record.add("smallest potential [V]", *std::min_element(v.begin(), v.end()));
    record.add("largest activation [-]",
               *std::max_element(gamma.begin(), gamma.end()));
  }
} // namespace ephyra::coupling
