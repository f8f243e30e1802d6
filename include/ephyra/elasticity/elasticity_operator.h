#pragma once

#include "ephyra/elasticity/body_measures.h"
#include "ephyra/elasticity/elasticity_parameters.h"
#include "ephyra/elasticity/patch_tables.h"
#include "ephyra/elasticity/side_loads.h"
#include "ephyra/linear_algebra/sparse_matrix.h"

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace ephyra::elasticity
{
  namespace internal
  {
    struct ElementWork;
  }

  /// Internal and external forces of an axisymmetric body, eqs. (56)-(58) of
  /// Nitti et al. 2023 (10.1016/j.apm.2023.08.003) with the hoop terms and
  /// without the doubled internal force, in total Lagrangian form:
  ///   F_int,a = 2 pi int P : grad R_a r dS,
  /// P the first Piola-Kirchhoff stress in the orthonormal cylindrical frame
  /// (see material.h), the integral by Gauss' rule per element.
  ///
  /// The active strain F = F_e F_a only changes the gradient of the basis that
  /// the passive law sees (grad_e R = F_a^-T grad R), because det F_a = 1 and
  /// F_a does not depend on the displacement.
  ///
  /// Vectors are replicated on all ranks, unknown 2 * point + component; the
  /// elements are shared among the ranks and the sums reduced, so that all
  /// functions that integrate are collective. Forces are those on the whole
  /// ring, N.
  class ElasticityOperator
  {
  public:
    using Parameters = ElasticityParameters;

    /// Throws InputError for an inverted patch, a degree above 6, a shortening
    /// of 0.95 or more at gamma = 1, sides that contradict each other.
    ElasticityOperator(const Parameters             &parameters,
                       const splines::NurbsPatch<2> &patch,
                       MPI_Comm                      comm);
    ~ElasticityOperator();

    int
    n_unknowns() const
    {
      return constraints.n_unknowns();
    }
    MPI_Comm
    communicator() const
    {
      return comm;
    }
    const Constraints &
    get_constraints() const
    {
      return constraints;
    }
    const splines::NurbsPatch<2> &
    patch() const
    {
      return body;
    }
    const Parameters &
    parameters() const
    {
      return prm;
    }

    /// Couplings of the unknowns through elements, with the diagonal of the
    /// unknowns that are eliminated; not yet compressed.
    linear_algebra::SparsityPattern
    sparsity_pattern() const;

    /// Stiffness and largest shortening in words, for the log.
    std::string
    description() const;

    // --- state of the loads ------------------------------------------------
    /// Loads and prescribed displacements at time t (s), times a factor.
    void
    set_time(double t, double load_factor = 1.);
    /// theta^1 of the Gauss lines, increasing.
    const std::vector<double> &
    activation_points() const
    {
      return tables.theta1;
    }
    /// gamma on the Gauss lines; constant across the thickness.
    void
    set_activation(const std::vector<double> &gamma);
    const std::vector<double> &
    activation() const
    {
      return gamma;
    }
    /// Largest shortening of a fibre at gamma = 1.
    double
    largest_shortening() const
    {
      return shortening;
    }

    // --- integrals ---------------------------------------------------------
    struct Evaluation
    {
      /// Smallest det F_e over the Gauss points; where it is not positive,
      /// nothing else is valid.
      double smallest_J;
      /// Size of the forces that cancel in the residual: norm of the sum of the
      /// absolute element forces, N. Unlike the residual it does not vanish in
      /// equilibrium, so that it is what residuals are compared with.
      double scale;
    };

    /// residual = F_int - F_ext at the displacement u, not condensed.
    Evaluation
    residual(const std::vector<double> &u, std::vector<double> &residual);
    /// Also adds stiffness_factor dR/du + mass_factor M to an open matrix, with
    /// the identity in the rows of eliminated unknowns. The caller closes it.
    Evaluation
    residual_and_tangent(const std::vector<double>    &u,
                         std::vector<double>          &residual,
                         linear_algebra::SparseMatrix &matrix,
                         double                        stiffness_factor,
                         double                        mass_factor);
    /// For the next tangent alone, which is to be at the displacement u + du:
    /// it takes the pressure 2 K (J - 1) of the volume at the Gauss points from
    /// the linear change of J from u on. Newton's method then converges as for
    /// a mixed form whose pressure at each Gauss point is an unknown of its own,
    /// in as many iterations for any K (mixed integration points, Magisano,
    /// Leonetti & Garcea 2017, 10.1002/nme.5496); what it converges to is the
    /// same.
    void
    predict_pressure(const std::vector<double> &u,
                     const std::vector<double> &du);
    /// residual += M a.
    void
    add_inertia(const std::vector<double> &a,
                std::vector<double>       &residual) const;
    /// Adds M, with the identity in the rows of eliminated unknowns.
    void
    add_mass(linear_algebra::SparseMatrix &matrix);

    /// Norm of the nodal forces of a unit strain, N: a strain tolerance times
    /// this is the smallest residual that means anything.
    double
    unit_force() const
    {
      return unit_force_norm;
    }

    /// Whether there are pressures, tractions or body forces.
    bool
    loaded() const
    {
      return !side_loads.empty() || !body_force_values.empty();
    }
    bool
    has_muscle() const
    {
      return active_strain.active();
    }
    /// Forces of the pressures, tractions and body forces at the displacement
    /// u and at the time that was set last, N.
    std::vector<double>
    external_force(const std::vector<double> &u) const;
    /// Axial position at the displacement, m.
    double
    centre_of_mass(const std::vector<double> &u) const;
    /// At the displacement, velocity and activation.
    BodyMeasures
    measures(const std::vector<double> &u,
             const std::vector<double> &v,
             const std::vector<double> &gamma) const;
    /// At the activation that was set last.
    BodyMeasures
    measures(const std::vector<double> &u, const std::vector<double> &v) const
    {
      return measures(u, v, gamma);
    }
    /// Work that the muscle has done (J) when the activation went from
    /// @p gamma_old at @p u_old to @p gamma_new at @p u_new:
    /// -int (F_e^T P_e) : (dF_a F_a^-1) by the midpoint rule.
    double
    muscle_work(const std::vector<double> &u_old,
                const std::vector<double> &gamma_old,
                const std::vector<double> &u_new,
                const std::vector<double> &gamma_new) const;
    PointFields
    fields(const std::vector<double> &u,
           const std::vector<double> &gamma,
           double                     theta1,
           double                     theta2) const;
    PointFields
    fields(const std::vector<double> &u,
           const double               theta1,
           const double               theta2) const
    {
      return fields(u, gamma, theta1, theta2);
    }

  private:
    Evaluation
    assemble(const std::vector<double>    &u,
             std::vector<double>          &residual,
             linear_algebra::SparseMatrix *matrix,
             double                        stiffness_factor,
             double                        mass_factor);
    /// Weighted positions of the points of an element into the work memory.
    void
    gather(const std::vector<double> &x, int element) const;
    template <int n2>
    bool
    element(int                           e,
            linear_algebra::SparseMatrix *matrix,
            double                        stiffness_factor,
            double                        mass_factor);
    /// Makes deformation_gradient(e, q) that of the positions x.
    void
    evaluate_positions(const std::vector<double> &x, int e) const;
    AxisymmetricTensor
    deformation_gradient(int e, int q) const;
    AxisymmetricTensor
    elastic_part(const AxisymmetricTensor &F,
                 const AxisymmetricTensor &active) const;
    void
    assemble_mass();
    void
    add_identity(linear_algebra::SparseMatrix &matrix) const;
    void
    check_shortening();

    Parameters             prm;
    splines::NurbsPatch<2> body;
    MPI_Comm               comm;
    int                    rank, n_ranks;
    int                    first_element, n_own_elements;
    ActiveStrain           active_strain;
    Constraints            constraints;
    PatchTables            tables;
    std::vector<SideLoad>  side_loads;
    std::vector<double>    body_force_values; ///< [component][e][q], N/m^3

    std::vector<double> reference; ///< positions, 2 * point + component, m
    std::vector<double> pattern;   ///< f_a at the Gauss points
    std::vector<double> gamma;     ///< on the Gauss lines
    std::vector<double> transform; ///< T with the active strain, as in tables
    std::vector<double> shift;     ///< F_a - I for small strain: [e][4][q]
    std::vector<int>    equations; ///< of the unknowns of each element
    double              shortening = 0.;
    std::vector<double> predicted_pressure; ///< [e][q], Pa; empty: none

    std::vector<double> element_mass; ///< [e][pair a1 <= b1][a2, b2], kg
    std::vector<int>    mass_start, mass_column; ///< of points, rows
    std::vector<double> mass_value;
    std::vector<double> lumped_mass; ///< row sums
    double              unit_force_norm = 0.;

    std::vector<double>                    position; ///< X + u
    std::vector<double>                    sums;     ///< residual, scale
    std::unique_ptr<internal::ElementWork> work;
  };
} // namespace ephyra::elasticity
