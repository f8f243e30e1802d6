#pragma once

#include <array>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::elasticity
{
  /// A tensor whose only components out of the meridional plane is the hoop
  /// one, in the orthonormal cylindrical frame (e_r, e_y, e_hoop):
  /// component[2 * i + J] = T_iJ in the plane (0 = r, 1 = y), component[4] the
  /// hoop one.
  using AxisymmetricTensor = std::array<double, 5>;

  /// dP_a / dF_b of the five components, symmetric, row-major 5 x 5.
  using AxisymmetricTangent = std::array<double, 25>;

  /// The weakly compressible neo-Hookean material of eq. (10) of Nitti et al.
  /// 2023 (10.1016/j.apm.2023.08.003),
  ///   Psi = c10 (I1 I3^(-1/3) - 3) + K (J - 1)^2,
  /// whose small-strain moduli are **mu = 2 c10 and kappa = 2 K**: c10 = 400 Pa
  /// and K = 5e4 Pa mean E = 2393.6 Pa and nu = 0.4960.
  ///
  /// Everything is evaluated in the orthonormal cylindrical frame rather than
  /// in the curvilinear one of the paper, and in terms of the deformation
  /// gradient F and the first Piola-Kirchhoff stress P = F S:
  ///   P    = a F + b H,   H = F^-T,
  ///   a    = 2 c10 J^(-2/3),  b = -a I1 / 3 + 2 K J (J - 1),
  ///   dP_iJ / dF_kL = a d_ik d_JL - 2a/3 (F_iJ H_kL + H_iJ F_kL)
  ///                 + (2/9 a I1 + 2 K J (2J - 1)) H_iJ H_kL - b H_iL H_kJ.
  /// F^-1 P is the stress of eq. (15), and dP/dF the tangent of eq. (16), in
  /// which I1 multiplies the last term of the first bracket, with the
  /// geometric part; both are checked in the tests.
  struct Material
  {
    double c10 = 400.; ///< Pa; half the shear modulus
    double K   = 5.e4; ///< Pa; half the bulk modulus
    /// Linear elasticity with mu = 2 c10, kappa = 2 K instead.
    bool small_strain = false;

    /// From Young's modulus (Pa) and Poisson's ratio.
    static Material
    from_young(double E, double nu);
    /// From the shear and the bulk modulus (Pa).
    static Material
    from_moduli(double mu, double kappa);

    double
    shear_modulus() const
    {
      return 2. * c10;
    }
    double
    bulk_modulus() const
    {
      return 2. * K;
    }

    double
    poisson_ratio() const
    {
      const double mu = shear_modulus(), kappa = bulk_modulus();
      return (3. * kappa - 2. * mu) / (2. * (3. * kappa + mu));
    }

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// Energy per reference volume (J/m^3), first Piola-Kirchhoff stress (Pa) and
  /// its derivative at one point. With an active strain, F is the elastic part
  /// F F_a^-1 (see active_strain.h).
  struct MaterialPoint
  {
    double              energy;
    AxisymmetricTensor  stress;
    AxisymmetricTangent tangent;
  };

  /// Determinant of F.
  double
  determinant(const AxisymmetricTensor &F);

  /// @pre determinant(F) > 0 unless the material is of small strain.
  MaterialPoint
  evaluate(const Material &material, const AxisymmetricTensor &F);

  /// Cauchy stress P F^T / J (Pa); for small strain the linear stress.
  AxisymmetricTensor
  cauchy_stress(const Material &material, const AxisymmetricTensor &F);
} // namespace ephyra::elasticity
