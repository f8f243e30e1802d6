#pragma once

#include "ephyra/linear_algebra/narrow_band.h"
#include "ephyra/splines/nurbs_patch.h"

#include <array>
#include <vector>

namespace ephyra::electrophysiology
{
  /// Matrices of the monodomain equation on the surface of revolution of a
  /// NURBS line, eqs. (69)-(72) of Nitti et al. 2023 without their common
  /// factor 2 pi:
  ///
  ///   M_ij = int N_i N_j r dL,   K_ij = int N_i' (1/G_11) N_j' r dL,
  ///
  /// ' = d/dtheta^1. G_11 is the covariant metric of the *deformed* line: the
  /// contravariant conductivity of isotropic conduction is D^11 = D_0/G_11.
  /// The measure r dL is that of the reference line (the paper), or that of
  /// the deformed one, which makes K the Laplace-Beltrami operator of the
  /// deformed surface. Gauss rules with degree + 1 points.
  ///
  /// An isolated cell is the degenerate case of one unknown, M = 1, K = 0.
  class MonodomainOperator
  {
  public:
    enum class Mass
    {
      consistent,
      lumped ///< row sums
    };
    enum class Measure
    {
      reference,
      deformed
    };

    MonodomainOperator(const splines::NurbsPatch<1> &line,
                       Mass                          mass,
                       Measure                       measure);
    /// Of an isolated cell.
    MonodomainOperator();

    int
    n_unknowns() const
    {
      return n;
    }
    int
    n_gauss_points() const
    {
      return n_elements * n_per_element;
    }
    int
    points_per_element() const
    {
      return n_per_element;
    }
    /// theta^1 of the Gauss points, element by element.
    const std::vector<double> &
    gauss_theta() const
    {
      return theta;
    }
    const std::vector<double> &
    greville() const
    {
      return greville_points;
    }
    /// Whether the line ends where it begins: the first and the last unknown
    /// are then one. The matrices do not know it; DiffusionStepper ties them.
    bool
    closed() const
    {
      return is_closed;
    }
    /// Longest element of the deformed line, m; 0 for an isolated cell.
    double
    longest_element() const;

    /// Metric of the deformed line at the Gauss points, G_11 in m^2 and r in
    /// m. Where nothing changed by more than @p tolerance (relative, since the
    /// matrices were last built) nothing is done and false returned.
    bool
    set_metric(const std::vector<double> &G11,
               const std::vector<double> &r,
               double                     tolerance);
    const std::vector<double> &
    metric_G11() const
    {
      return G11;
    }
    const std::vector<double> &
    metric_r() const
    {
      return r;
    }

    /// The matrix of the time derivative, consistent or lumped.
    const linear_algebra::NarrowBandMatrix &
    mass() const
    {
      return mass_kind == Mass::lumped ? lumped_mass_matrix : mass_matrix;
    }
    const linear_algebra::NarrowBandMatrix &
    consistent_mass() const
    {
      return mass_matrix;
    }
    const linear_algebra::NarrowBandMatrix &
    stiffness() const
    {
      return stiffness_matrix;
    }
    /// N_j at the Greville point i.
    const linear_algebra::NarrowBandMatrix &
    collocation() const
    {
      return collocation_matrix;
    }

    /// Values at the Gauss points. They are ordered point by point of the
    /// elements (all first points, all second points, ...), so that loops over
    /// elements vectorise.
    void
    interpolate(const double *coefficients, double *gauss_values) const;
    /// int N_i f r dL from f at the Gauss points, in the same order.
    void
    integrate(const double *gauss_values, double *load) const;
    /// int N_i r dL over a part of the reference line, integrated exactly to
    /// its ends.
    std::vector<double>
    interval_load(const std::array<double, 2> &interval) const;
    /// int N_i r dL: the share of each function in the surface.
    void
    shares(std::vector<double> &values) const;
    /// Basis functions at any theta^1: their values and the first index.
    void
    basis(double theta, int &first, std::vector<double> &values) const;

  private:
    void
    assemble();

    std::vector<splines::NurbsPatch<1>> line; ///< none for an isolated cell
    Mass                                mass_kind     = Mass::consistent;
    Measure                             measure_kind  = Measure::reference;
    bool                                is_closed     = false;
    int                                 n             = 1;
    int                                 n_elements    = 1;
    int                                 n_per_element = 1;
    int                                 n_local       = 1;
    std::vector<double>                 theta;
    std::vector<double>                 greville_points;
    std::vector<int>                    first; ///< function of each element

    // At Gauss point q of element e: function a at (q n_local + a) n_elements
    // + e; the others at e n_per_element + q.
    std::vector<double> values, derivatives;
    std::vector<double> weight;            ///< Gauss weight in theta^1
    std::vector<double> reference_measure; ///< r dL/dtheta
    std::vector<double> G11, r;            ///< deformed
    std::vector<double> measure;           ///< weight r dL/dtheta, by points

    linear_algebra::NarrowBandMatrix mass_matrix, lumped_mass_matrix,
      stiffness_matrix, collocation_matrix;
    mutable std::vector<double> shifted; ///< work space
  };
} // namespace ephyra::electrophysiology
