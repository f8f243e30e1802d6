#pragma once

#include "ephyra/coupling/activation_source.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"
#include "ephyra/splines/nested_patch.h"
#include "ephyra/splines/nurbs_patch.h"

namespace ephyra::coupling
{
  /// Activation by the nerve net on the subumbrellar line of a body: the line
  /// is the side theta^2 = 0 of the patch, refined by nested elements. The
  /// deformed metric and radius of the line come from the displacement of the
  /// patch, the activation goes back to it, both by precomputed matrices
  /// (section 3.3 of Nitti et al. 2023, 10.1016/j.apm.2023.08.003).
  class NerveNet : public ActivationSource
  {
  public:
    /// @p patch the body, @p n_nested elements of the line in each of its
    /// elements, @p activation_points the theta^1 where activation() is wanted.
    /// Logs the number of points.
    NerveNet(
      const electrophysiology::ElectrophysiologySolver::Parameters &parameters,
      const splines::NurbsPatch<2>                                 &patch,
      int                                                           n_nested,
      const std::vector<double> &activation_points,
      MPI_Comm                   comm);

    StepStatus
    advance(double                     t,
            double                     dt,
            const std::vector<double> &displacement) override;
    const std::vector<double> &
    activation() const override
    {
      return gamma;
    }
    void
    serialize(Archive &archive) override;
    void
    evaluate(Record &record) const override;

    const electrophysiology::ElectrophysiologySolver &
    tissue() const
    {
      return solver;
    }
    const splines::NurbsPatch<1> &
    line() const
    {
      return nested.patch();
    }

  private:
    void
    sample_activation(double t);

    const splines::NestedPatch                 nested;
    electrophysiology::ElectrophysiologySolver solver;
    splines::EvaluationMatrix line_of_patch;    ///< patch to metric points
    splines::EvaluationMatrix to_mechanics;     ///< line to activation points
    std::vector<double>       reference;        ///< positions of the patch
    std::vector<double>       position, G11, r; ///< work space
    std::vector<double>       coefficients, gamma;
  };
} // namespace ephyra::coupling
