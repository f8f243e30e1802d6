#pragma once

#include "ephyra/electrophysiology/awake_ranges.h"
#include "ephyra/electrophysiology/ionic_model.h"
#include "ephyra/electrophysiology/monodomain_operator.h"

#include <memory>
#include <vector>

namespace ephyra::electrophysiology
{
  /// Where gates and synapses live, and how the ionic currents reach the weak
  /// form (eq. 71).
  enum class Placement
  {
    /// Gates are spline coefficients, advanced with the coefficients of v; the
    /// current is evaluated at the Gauss points from interpolated v and gates
    /// (state variable interpolation, eq. 75). Second order for every degree.
    control_coefficients,
    /// Gates and currents at the Greville points with the values of v there;
    /// the current enters as the spline through its values. One evaluation for
    /// each unknown.
    greville_points,
    /// Gates and currents at the Gauss points: degree + 1 times the work.
    quadrature_points
  };

  /// Currents that enter the weak form point by point, each times its share
  /// int N_i r dL of the surface, instead of as a function of space. With the
  /// consistent mass matrix they sharpen the front and slow it on coarse
  /// meshes; to compare with the paper. Not at quadrature points.
  enum class NodalCurrents
  {
    none,
    synaptic, ///< i_syn; the ionic currents as the placement says
    all
  };

  /// State of the points that carry gates and synapses, as the reaction needs
  /// it; arrays of n_points values (gates: one array after another).
  struct PointState
  {
    const double      *v;
    const double      *gates;
    const double      *synapse; ///< conductance over capacitance, 1/s
    const AwakeRanges *awake;
  };

  /// Evaluates the reaction part of the monodomain equation in one placement.
  class Reaction
  {
  public:
    virtual ~Reaction() = default;

    virtual int
    n_points() const = 0;
    /// Potential at the points from its control coefficients.
    virtual void
    to_points(const double *coefficients, double *point_values) const = 0;
    /// Control coefficients of the spline that has (or, at quadrature points,
    /// best approximates) the given values.
    virtual void
    to_coefficients(const double *point_values, double *coefficients) const = 0;
    /// Load int N_i f r dL of the reaction f, in n_unknowns values.
    virtual void
    load(const PointState &state, double *load) = 0;
    /// To be called when the matrices of the operator have changed.
    virtual void
    metric_changed() = 0;
    /// theta^1 that a point stands for (Greville abscissa for coefficients).
    virtual const std::vector<double> &
    theta() const = 0;
  };

  /// References are kept: operator and model must live on.
  std::unique_ptr<Reaction>
  make_reaction(Placement                 placement,
                NodalCurrents             nodal,
                const MonodomainOperator &monodomain,
                const IonicModel         &model);
} // namespace ephyra::electrophysiology
