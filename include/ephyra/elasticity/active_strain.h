#pragma once

#include "ephyra/base/expression.h"
#include "ephyra/elasticity/material.h"
#include "ephyra/splines/nurbs_patch.h"

#include <optional>

namespace ephyra::elasticity
{
  /// Covariant base vectors of the reference configuration and the radius:
  /// what the direction of muscle fibres depends on.
  struct ReferenceFrame
  {
    splines::Point g1; ///< dX / dtheta^1, m
    splines::Point g2; ///< dX / dtheta^2, m
    double         r;  ///< distance from the axis, m; > 0
  };

  /// The active part F_a of F = F_e F_a (eqs. 19-30 of Nitti et al. 2023,
  /// 10.1016/j.apm.2023.08.003): a prescribed shortening of radial (a1) and
  /// coronal (a3) muscle fibres in a layer, without change of volume.
  ///
  /// *Unit directors*: with the fibre f = g_1/|g_1|, its normal n in the
  /// section and e_3 the hoop direction, all of the reference shape,
  ///   F_a = (1 - gamma a1) f f + (1 - gamma a3) e_3 e_3
  ///       + [(1 - gamma a1)(1 - gamma a3)]^-1 n n,
  /// so that a1 and a3 are true shortening fractions on any mesh.
  ///
  /// *Paper metric*: eqs. (25)-(27) taken literally,
  ///   F_a = I - gamma (a1 L^2 g^1 g^1 + a3 L^2 g^3 g^3) + gamma_2 g^2 g^2,
  /// with contravariant, not unit, vectors and lengths in the unit L, so that
  /// the hoop shortening is gamma a3 L^2/r^2. It is singular at the axis, where
  /// f_a keeps a small tail: f_a is multiplied by a smooth step there.
  ///
  /// a_k = amplitude_k f_a(theta^1, theta^2), f_a eq. (30) or a formula.
  class ActiveStrain
  {
  public:
    enum class Form
    {
      none,
      unit_directors,
      paper_metric
    };

    struct Parameters
    {
      Form   form = Form::none;
      double a1 = 0., a3 = 0.096; ///< amplitudes of eqs. (28), (29)
      /// Steepness and position of the edges of the layer, eq. (30).
      double w1 = 10., w2 = 40., delta1 = 0.55, delta2 = 0.2;
      /// Replaces eq. (30): formula in theta1, theta2.
      std::optional<Expression> pattern;
      double length = 0.03; ///< L of the paper metric, m: 2 a_ex
      /// theta^1 where the smooth step of the paper metric starts and ends;
      /// equal values: none.
      double cut_start = 0.1, cut_end = 0.25;

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// Shortenings from this on are refused.
    static constexpr double largest_shortening = 0.95;

    explicit ActiveStrain(const Parameters &parameters);

    bool
    active() const
    {
      return prm.form != Form::none;
    }

    /// f_a at a point of the patch.
    double
    pattern(double theta1, double theta2) const;

    /// The larger of the two shortenings at gamma f_a = @p activity.
    double
    shortening(const ReferenceFrame &frame, double activity) const;

    /// F_a, symmetric, determinant 1, at gamma f_a = @p activity.
    AxisymmetricTensor
    deformation(const ReferenceFrame &frame, double activity) const;

  private:
    Parameters prm;
  };

  /// Inverse of an axisymmetric tensor.
  AxisymmetricTensor
  inverse(const AxisymmetricTensor &T);
} // namespace ephyra::elasticity
