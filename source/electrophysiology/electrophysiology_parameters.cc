// Entries of the parameter file for the electrophysiology solver.
#include "ephyra/base/parameter_handler.h"
#include "ephyra/electrophysiology/electrophysiology_solver.h"

namespace ephyra::electrophysiology
{
  void
  ElectrophysiologySolver::Parameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Electrophysiology");
    prm.declare_entry("Ionic model",
                      "jellyfish neuron",
                      patterns::Selection("jellyfish neuron|Nagumo|none"),
                      "Reaction part of the monodomain equation.");
    prm.declare_entry("Conductivity",
                      "1.3745e-8 S/m",
                      patterns::Double("S/m", 0.),
                      "D_0. Only its ratio to the capacitance counts; the "
                      "default gives 47.5 cm/s.");
    prm.declare_entry("Capacitance",
                      "1e-3 F/m^3",
                      patterns::Positive("F/m^3"),
                      "C_m, membrane capacitance per volume of tissue.");
    prm.declare_entry("Time step",
                      "5 us",
                      patterns::Positive("s"),
                      "Largest substep. The explicit ionic currents of the "
                      "jellyfish neuron are stable up to about 79 us; 20 us "
                      "make the wave 0.35 % too slow, 5 us 0.02 %.");
    prm.declare_entry("Resting time step",
                      "0.5 ms",
                      patterns::Double("s", 0.),
                      "Substep while jellyfish neurons rest; the next "
                      "stimulus is met exactly. 0: always the time step.");
    prm.declare_entry("Resting rate",
                      "0.1 V/s",
                      patterns::Positive("V/s"),
                      "Where the potential changes more slowly than this "
                      "everywhere, the resting time step is taken; before, "
                      "the longest of twice, four times ... the time step in "
                      "which it changes by less than resting rate times "
                      "resting time step.");
    prm.declare_entry("Resting gates",
                      "0.05",
                      patterns::Double("", 0., 1.),
                      "Largest distance of any gate from its steady value for "
                      "which steps grow.");
    prm.declare_entry("Sleep tolerance",
                      "0.1 uV",
                      patterns::Double("V", 0., 1e-3),
                      "Blocks of 32 points whose potential is as close as this "
                      "to the resting potential, with gates and synapses at "
                      "rest accordingly, are not computed. 0: all are.");
    prm.declare_entry(
      "Placement",
      "Greville points",
      patterns::Selection(
        "Greville points|control coefficients|quadrature points"),
      "Where gates and ionic currents are computed.");
    prm.declare_entry("Nodal currents",
                      "none",
                      patterns::Selection("none|synaptic|all"),
                      "Currents that enter the weak form point by point, each "
                      "times its share of the surface, instead of as a "
                      "function of space. With the consistent mass matrix "
                      "they make the wave slow on coarse meshes; to compare "
                      "with the paper.");
    prm.declare_entry("Gate potential",
                      "midpoint",
                      patterns::Selection("midpoint|end"),
                      "Potential that the gates see during a step: the mean of "
                      "old and new (second order) or the new one (first "
                      "order).");
    prm.declare_entry("Linear solver",
                      "narrow band",
                      patterns::Selection("narrow band|LAPACK|Amesos2"),
                      "Direct solver of the monodomain equation: factors "
                      "without pivoting on every rank (fastest), LAPACK's band "
                      "LU on every rank, or Trilinos: a Tpetra matrix "
                      "assembled by all ranks, and KLU2.");
    prm.declare_entry("Mass matrix",
                      "consistent",
                      patterns::Selection("consistent|lumped"),
                      "Matrix of the time derivative.");
    prm.declare_entry("Measure",
                      "reference",
                      patterns::Selection("reference|deformed"),
                      "Surface element of the integrals: of the undeformed or "
                      "of the deformed line.");
    prm.declare_entry("Metric tolerance",
                      "1e-3",
                      patterns::Double("", 0.),
                      "Relative change of the deformed metric below which the "
                      "matrices are kept.");
    prm.declare_entry("Initial potential",
                      "",
                      patterns::Anything(),
                      "Formula in s = theta^1, V; empty: the resting "
                      "potential.");
    MnnNeuron::Parameters::declare(prm);
    Nagumo::Parameters::declare(prm);
    Synapses::Parameters::declare(prm);
    Stimulus::Parameters::declare(prm);
    Activation::Parameters::declare(prm);
    BoundaryCondition::Parameters::declare(prm, "Start of the line");
    BoundaryCondition::Parameters::declare(prm, "End of the line");
  }

  void
  ElectrophysiologySolver::Parameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Electrophysiology");
    const std::string               model_name = prm.get("Ionic model");
    model                   = model_name == "Nagumo" ? Model::nagumo
                              : model_name == "none" ? Model::none
                                                     : Model::jellyfish_neuron;
    conductivity            = prm.get_double("Conductivity");
    capacitance             = prm.get_double("Capacitance");
    time_step               = prm.get_double("Time step");
    resting_time_step       = prm.get_double("Resting time step");
    resting_rate            = prm.get_double("Resting rate");
    resting_gates           = prm.get_double("Resting gates");
    sleep_tolerance         = prm.get_double("Sleep tolerance");
    const std::string place = prm.get("Placement");
    placement = place == "Greville points" ? Placement::greville_points
                : place == "quadrature points"
                  ? Placement::quadrature_points
                  : Placement::control_coefficients;
    const std::string nodal = prm.get("Nodal currents");
    nodal_currents          = nodal == "all"        ? NodalCurrents::all
                              : nodal == "synaptic" ? NodalCurrents::synaptic
                                                    : NodalCurrents::none;
    if (nodal_currents != NodalCurrents::none &&
        placement == Placement::quadrature_points)
      prm.add_error("Nodal currents",
                    "currents at quadrature points are functions of space; "
                    "choose another Placement");
    gate_potential           = prm.get("Gate potential") == "end"
                                 ? GatePotential::end
                                 : GatePotential::midpoint;
    using LinearSolver       = DiffusionStepper::LinearSolver;
    const std::string solver = prm.get("Linear solver");
    linear_solver            = solver == "Amesos2"  ? LinearSolver::amesos2
                               : solver == "LAPACK" ? LinearSolver::lapack_band
                                                    : LinearSolver::narrow_band;
    mass                     = prm.get("Mass matrix") == "lumped"
                                 ? MonodomainOperator::Mass::lumped
                                 : MonodomainOperator::Mass::consistent;
    measure                  = prm.get("Measure") == "deformed"
                                 ? MonodomainOperator::Measure::deformed
                                 : MonodomainOperator::Measure::reference;
    metric_tolerance         = prm.get_double("Metric tolerance");
    initial_potential        = prm.get("Initial potential");
    if (!initial_potential.empty())
      {
        const patterns::Expression formula({"s"}, "V");
        const std::string          problem = formula.error(initial_potential);
        if (problem.empty())
          initial_potential = formula.resolve(initial_potential, "");
        else
          prm.add_error("Initial potential", problem + ".");
      }
    neuron.parse(prm);
    nagumo.parse(prm);
    synapses.parse(prm);
    stimulus.parse(prm);
    activation.parse(prm);
    start.parse(prm, "Start of the line");
    end.parse(prm, "End of the line");
  }
} // namespace ephyra::electrophysiology
