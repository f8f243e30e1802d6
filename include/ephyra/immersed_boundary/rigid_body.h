#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/base/expression.h"
#include "ephyra/geometry/bell.h"
#include "ephyra/immersed_boundary/boundary_curve.h"

#include <string>

namespace ephyra
{
  class ParameterHandler;
}

namespace ephyra::immersed_boundary
{
  /// A rigid axisymmetric body that moves along the axis only: fixed, moved by
  /// a law, or free under gravity and the loads of the fluid.
  class RigidBody
  {
  public:
    enum class Motion
    {
      fixed,
      prescribed,
      free
    };
    /// Fluid that the forcing leaves inside a free body (Uhlmann 2005,
    /// 10.1016/j.jcp.2005.03.017; Kempe & Froehlich 2012,
    /// 10.1016/j.jcp.2012.01.021).
    enum class InteriorFluid
    {
      automatic, ///< rigid unless the body is lighter than the fluid
      rigid,     ///< its momentum is m_f V
      measured   ///< its momentum is integrated after the projection
    };
    /// Side of the body on which its wake is looked for.
    enum class Wake
    {
      none,
      above, ///< towards larger y
      below
    };
    /// Section "Rigid body NAME".
    struct Parameters
    {
      std::string name  = "body";
      std::string shape = "sphere"; ///< sphere, spheroid, torus, disk, rod,
                                    ///< tube, bell or file
      /// Dimensions, m: what the shape does not have is ignored.
      double radius       = 0.5;  ///< sphere, spheroid, disk, rod, tube
      double half_height  = 0.5;  ///< spheroid
      double ring_radius  = 0.75; ///< torus
      double core_radius  = 0.25; ///< torus
      double inner_radius = 0.25; ///< tube
      double length       = 1.;   ///< rod, tube
      double thickness    = 0.1;  ///< disk
      geometry::BellParameters bell;
      std::string              file_name;
      double                   position = 0; ///< y of the reference point, m
      Motion                   motion   = Motion::fixed;
      std::string              velocity = "0"; ///< law, m/s in t
      double                   density  = 1000;
      double                   gravity  = -9.81; ///< along y
      InteriorFluid            interior = InteriorFluid::automatic;
      /// For drag coefficients, left out of the output at velocity 0; the
      /// area 0 is that of the largest section.
      double reference_velocity = 0;
      double reference_area     = 0;
      Wake   wake               = Wake::none;
      bool   surface_profiles   = false;

      static void
      declare(ParameterHandler &prm);
      void
      parse(ParameterHandler &prm);
    };

    /// A body of one of the shapes.
    explicit RigidBody(const Parameters &parameters);
    /// A body of any closed outline, its y = 0 being moved to `position`.
    RigidBody(const Parameters &parameters, Outline outline);

    const Parameters parameters;
    const Outline    outline;
    const double     volume;         ///< exact, m^3
    const double     mass;           ///< kg
    const double     reference_area; ///< m^2

    double position;         ///< of the reference point, y in m
    double velocity     = 0; ///< m/s
    double acceleration = 0; ///< over the last step, m/s^2

    bool
    is_free() const
    {
      return parameters.motion == Motion::free;
    }
    /// Prescribed velocity at a time (0 of a fixed body).
    double
    law(double time) const;
    /// Displacement by the law from one time to another, by Gauss quadrature.
    double
    displacement(double from, double to) const;

    void
    serialize(Archive &archive);

  private:
    Expression velocity_law;
  };
} // namespace ephyra::immersed_boundary
