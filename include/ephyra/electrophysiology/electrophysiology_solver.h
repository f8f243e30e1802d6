#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/step_status.h"
#include "ephyra/electrophysiology/activation.h"
#include "ephyra/electrophysiology/boundary_condition.h"
#include "ephyra/electrophysiology/crossing_probes.h"
#include "ephyra/electrophysiology/diffusion_stepper.h"
#include "ephyra/electrophysiology/front_tracker.h"
#include "ephyra/electrophysiology/mnn_neuron.h"
#include "ephyra/electrophysiology/monodomain_operator.h"
#include "ephyra/electrophysiology/nagumo.h"
#include "ephyra/electrophysiology/reaction.h"
#include "ephyra/electrophysiology/stimulus.h"
#include "ephyra/electrophysiology/synapses.h"

#include <mpi.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ephyra::electrophysiology
{
  /// The monodomain equation on a line (or an isolated cell without one),
  ///
  ///   dv/dt = kappa lap v + f(v, G, s) + i_a/C_m,   kappa = D_0/C_m,
  ///
  /// eqs. (31), (68)-(75) of Nitti et al. 2023 (10.1016/j.apm.2023.08.003).
  /// Diffusion by Crank-Nicolson, reaction by the second-order Adams-Bashforth
  /// method (variable steps; started with one predictor-corrector step), i_a
  /// by its mean over the step, gates by Runge-Kutta 4 with v frozen.
  ///
  /// Everything is replicated: each rank computes all of it, and the first
  /// rank's state is copied to the others after each macro step.
  class ElectrophysiologySolver
  {
  public:
    enum class Model
    {
      jellyfish_neuron,
      nagumo,
      none ///< diffusion only
    };
    /// Potential that the gates of a step see.
    enum class GatePotential
    {
      midpoint, ///< mean of old and new: second order
      end       ///< the new one (the paper): first order
    };

    struct Parameters
    {
      Model                         model = Model::jellyfish_neuron;
      MnnNeuron::Parameters         neuron;
      Nagumo::Parameters            nagumo;
      Synapses::Parameters          synapses;
      Stimulus::Parameters          stimulus;
      Activation::Parameters        activation;
      BoundaryCondition::Parameters start; ///< end of the line at theta^1 = 0
      BoundaryCondition::Parameters end;   ///< end of the line at theta^1 = 1

      double conductivity = 1.3745e-8; ///< D_0, S/m
      double capacitance  = 1e-3;      ///< C_m per volume, F/m^3
      double time_step    = 5e-6;      ///< largest substep Delta t_e, s
      /// Substep while neurons rest, s; 0: always the time step.
      double resting_time_step = 0.5e-3;
      /// max |dv/dt| for the resting step, V/s; between, a step may change
      /// the potential by resting_rate * resting_time_step.
      double resting_rate = 0.1;
      /// Largest distance of a gate from its steady value for longer steps.
      double resting_gates = 0.05;
      /// Distance from the resting potential within which blocks of points
      /// are not computed, V; 0: all are.
      double                   sleep_tolerance = 1e-7;
      Placement                placement       = Placement::greville_points;
      NodalCurrents            nodal_currents  = NodalCurrents::none;
      GatePotential            gate_potential  = GatePotential::midpoint;
      MonodomainOperator::Mass mass = MonodomainOperator::Mass::consistent;
      DiffusionStepper::LinearSolver linear_solver =
        DiffusionStepper::LinearSolver::narrow_band;
      MonodomainOperator::Measure measure =
        MonodomainOperator::Measure::reference;
      /// Relative change of the metric below which matrices are kept.
      double metric_tolerance = 1e-3;
      /// Initial potential in s = theta^1, V; empty: at rest.
      std::string initial_potential;

      /// In a subsection "Electrophysiology".
      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
      double
      diffusivity() const ///< kappa, m^2/s
      {
        return conductivity / capacitance;
      }
    };

    /// On a line, already refined as the front needs it.
    ElectrophysiologySolver(const Parameters             &parameters,
                            const splines::NurbsPatch<1> &line,
                            MPI_Comm                      comm);
    /// An isolated cell: one point, no diffusion, never the release trigger.
    ElectrophysiologySolver(const Parameters &parameters, MPI_Comm comm);
    /// Its parts refer to each other.
    ElectrophysiologySolver(const ElectrophysiologySolver &) = delete;
    ElectrophysiologySolver &
    operator=(const ElectrophysiologySolver &) = delete;

    // --- deformation --------------------------------------------------------
    /// theta^1 of the points where the metric is wanted.
    const std::vector<double> &
    metric_points() const
    {
      return monodomain.gauss_theta();
    }
    /// Covariant metric G_11 (m^2) and radius (m) of the deformed line there;
    /// until the first call those of the reference line. Returns whether the
    /// change was beyond the metric tolerance and the matrices are new.
    bool
    set_deformed_metric(const std::vector<double> &G11,
                        const std::vector<double> &r);

    // --- time ---------------------------------------------------------------
    /// From t to t + dt in substeps up to the parameter, or longer ones where
    /// little happens. At rest the state may stay behind t + dt by less than
    /// the resting time step; an event is always met exactly.
    StepStatus
    advance(double t, double dt);
    std::int64_t
    n_substeps() const
    {
      return substeps;
    }
    /// Steps have grown to the resting time step.
    bool
    resting() const;
    /// Of the matrix of a substep, since the construction.
    std::int64_t
    n_factorizations() const
    {
      return diffusion.n_factorizations();
    }
    /// Mean share of the points that were computed in a substep.
    double
    awake_share() const
    {
      return substeps > 0 && n_points() > 0
               ? static_cast<double>(awake_points) /
                   (static_cast<double>(substeps) * n_points())
               : 1.;
    }

    // --- state --------------------------------------------------------------
    int
    n_control_points() const
    {
      return monodomain.n_unknowns();
    }
    /// Potential, control coefficients, V.
    const std::vector<double> &
    potential() const
    {
      return v;
    }
    const IonicModel *
    ionic_model() const
    {
      return model.get();
    }
    /// Gate k, control coefficients.
    void
    gate(int k, std::vector<double> &coefficients) const;
    /// Synaptic conductance over capacitance, 1/s, control coefficients.
    void
    synapse(std::vector<double> &coefficients) const;
    /// Ionic and synaptic currents for a potential (V), all gates and a
    /// synaptic conductance over capacitance (1/s): A/m^3 of capacitance C_m,
    /// outward positive, in the order of ionic_model()->current_names().
    std::vector<double>
    currents(double                     potential,
             const std::vector<double> &gates,
             double                     synapse) const;
    /// The same of one state point.
    std::vector<double>
    currents(int point) const;
    int
    n_points() const ///< that carry gates and synapses
    {
      return reaction ? reaction->n_points() : 0;
    }
    /// Muscle activation at a time up to the current one, control coefficients
    /// of the line; all zero without a gate that activates.
    void
    activation(double t, std::vector<double> &coefficients) const;
    double
    potential_at(double theta) const; ///< V
    const Synapses *
    synapse_state() const
    {
      return synapses ? &*synapses : nullptr;
    }
    const Activation *
    activation_state() const
    {
      return muscle ? &*muscle : nullptr;
    }
    /// Control coefficients of the spline on the line that has the values of
    /// a function of theta^1 at the Greville points.
    std::vector<double>
    interpolate(const std::function<double(double)> &function) const;
    /// Replaces the potential, e.g. by an exact solution in theta^1. On a
    /// closed line its values at 0 and 1 have to agree, else InputError.
    void
    set_potential(const std::function<double(double)> &potential);

    /// Watches the upward crossings of a level (V) at a place; returns the
    /// number of the probe. Call before the first step.
    int
    add_crossing_probe(double theta, double level);
    /// Times of the crossings so far, s, interpolated inside the steps.
    const std::vector<double> &
    crossing_times(int probe) const
    {
      return probes.times(probe);
    }

    /// Largest value so far of the gate that activates the muscle, at the point
    /// nearest to a probe; 0 without such a gate.
    double
    largest_gate(const int probe) const
    {
      return largest_gates[probe];
    }
    /// Why the front has not come to a probe by the time t; see FrontTracker.
    std::string
    why_not_reached(int probe, double t) const;
    /// Pulses of the stimulus that began before t.
    int
    n_pulses_before(const double t) const
    {
      return stimulus.n_pulses_before(t);
    }

    /// Empty where the mesh resolves a front and the time step is stable; else
    /// what is wrong. The elements are measured on the deformed line.
    std::string
    resolution_problem() const;

    void
    serialize(Archive &archive);

  private:
    void
    initialize();
    /// What depends on the matrices of the operator.
    void
    metric_changed();
    void
    substep(double t, double dt);
    /// Increment of the potential for the given reaction load.
    void
    solve_increment(double t, double dt, const std::vector<double> &reaction);
    /// v by the increment, then gates and synapses.
    void
    advance_state(double t, double dt);
    void
    evaluate_load(std::vector<double> &load);
    /// The reaction that counts in a step without a usable one before it: the
    /// mean of now and of a predicted end.
    void
    predict_load(double t, double dt);
    const double *
    synaptic_conductance() const;
    void
    update_awake();
    double
    largest_step() const;
    /// Back to the time step of a pulse.
    void
    wake();
    /// Doubles or halves the step by how fast the potential changed in the
    /// last one and by how far gates are from their steady values.
    void
    adapt_step(double dt);
    double
    distance_of_gates() const;
    bool
    blown_up() const;
    std::string
    failure_reason(double t, double dt) const;
    void
    synchronize();

    Parameters                  prm;
    MPI_Comm                    comm;
    std::unique_ptr<IonicModel> model;
    MonodomainOperator          monodomain;
    std::unique_ptr<Reaction>   reaction;
    Stimulus                    stimulus;
    DiffusionStepper            diffusion;
    std::optional<Synapses>     synapses;
    std::optional<Activation>   muscle;
    CrossingProbes              probes;
    std::optional<FrontTracker> front;        ///< with probes
    std::vector<int>            probe_points; ///< nearest point of each probe
    std::vector<double>         stimulus_load;
    /// Coefficients of the stimulated part, where its load has to follow a
    /// deformed measure; else empty.
    std::vector<double> stimulus_shape;
    /// Factors of the consistent mass matrix, where the measure is deformed.
    linear_algebra::NarrowBandSolver mass_factors;
    std::vector<int>                 stimulated_points;
    bool                             may_rest = false;

    // State.
    std::vector<double> v;             ///< control coefficients
    std::vector<double> gates;         ///< gate k of point i at k n_points + i
    std::vector<double> load;          ///< of the reaction, now
    std::vector<double> previous_load; ///< one step ago
    double              previous_dt       = 0; ///< 0: no step yet
    std::int64_t        step_doublings    = 0; ///< of the time step
    double              calm_time         = 0; ///< since the last change of it
    double              behind            = 0; ///< s not yet computed, at rest
    double              epscs_given_until = -1;
    std::int64_t        substeps          = 0;
    std::int64_t        awake_points      = 0; ///< summed over the substeps
    std::vector<double> largest_gates;         ///< of each probe

    // Work space.
    std::vector<double> increment, total_load, old_v, points_v, old_points_v,
      middle_v, gates_backup, combined_load, no_synapses;
    std::optional<Synapses>     synapses_backup;
    mutable std::vector<double> point_values;
    AwakeRanges                 awake{nullptr, 0, 0.};

    static constexpr double calm_time_needed = 0.5e-3; ///< for a doubling, s
  };
} // namespace ephyra::electrophysiology
