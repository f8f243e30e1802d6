#pragma once

#include "ephyra/geometry/body_patch.h"
#include "ephyra/geometry/discretization.h"

namespace ephyra::geometry
{
  /// The bell of an oblate medusa, section 2.7 and eq. (49) of Nitti et al.
  /// 2023 (10.1016/j.apm.2023.08.003) with b_in = 0.46 a_ex: between two
  /// quarter ellipses of one centre, elongated along their vertical tangents
  /// by a straight flap and closed by the circular arc of the given radius
  /// through the two end points of the flap.
  ///
  /// theta^1 runs from the axis (0) to the margin (1), theta^2 from the
  /// subumbrellar surface (0) to the exumbrellar one (1). The apex is up: the
  /// animal swims along +y. All curves are exact conics. Each ellipse is one
  /// conic segment whose weights give it the same speed at both ends, the
  /// flap runs at constant speed, and both meet at the theta^1 that makes the
  /// mean subumbrellar speed on both the same (0.8906 by default). There the
  /// parametrisation has a kink (knot of multiplicity degree), the curves
  /// only a jump of curvature. With the default dimensions |g_1| is between
  /// 15.7 and 21.8 mm on the subumbrellar ellipse, 19.2 mm on the flap, and
  /// between 19.2 and 25.5 mm on the exumbrellar surface; g_1 and g_2 meet at
  /// 86 to 109 degrees (44 to 136 at the corners of the margin, where the arc
  /// meets the flap), and theta^2 is the relative distance across the body to
  /// within 0.065.
  struct BellParameters
  {
    double radius        = 0.015; ///< a_ex, m; all others are fractions of it
    double outer_height  = 0.8;   ///< b_ex / a_ex
    double inner_radius  = 0.948; ///< a_in / a_ex
    double inner_height  = 0.46;  ///< b_in / a_ex
    double flap_length   = 0.14;  ///< d / a_ex
    double margin_radius = 0.036; ///< of the closing arc, over a_ex

    static void
    declare(ParameterHandler &prm);
    void
    parse(const ParameterHandler &prm);

    /// Throws InputError on dimensions that do not make a bell.
    void
    check() const;
    /// theta^1 where ellipses and flap meet.
    double
    joint() const;
  };

  /// The bell with its exumbrellar apex at the height @p apex, m.
  BodyPatch
  make_bell(const BellParameters &parameters,
            double                apex,
            const Discretization &discretization);

  /// The subumbrellar line of a bell alone, with the parametrisation that it
  /// has there: a quarter ellipse with the half axes @p a and @p b (m), from
  /// the axis, and a flap of the length @p flap along its vertical tangent.
  BodyCurve
  make_subumbrella(double                a,
                   double                b,
                   double                flap,
                   double                center,
                   const Discretization &discretization);
} // namespace ephyra::geometry
