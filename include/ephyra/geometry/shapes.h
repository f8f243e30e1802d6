#pragma once

#include "ephyra/geometry/bell.h"
#include "ephyra/geometry/body_patch.h"
#include "ephyra/geometry/discretization.h"

#include <string>

namespace ephyra::geometry
{
  /// A deformable body by the name of its shape, as a parameter file gives it.
  struct BodyParameters
  {
    /// bell, tube, rod, disk, hollow sphere or file.
    std::string    shape          = "bell";
    double         axial_position = 0.; ///< y of the reference point, m
    Discretization discretization;
    BellParameters bell;
    double         radius       = 0.01;   ///< rod and disk, m
    double         inner_radius = 0.005;  ///< tube and hollow sphere, m
    double         outer_radius = 0.01;   ///< tube and hollow sphere, m
    double         length       = 0.02;   ///< tube and rod, m
    double         thickness    = 0.001;  ///< disk, m
    std::string    section      = "half"; ///< hollow sphere: quarter or half
    std::string    file_name;             ///< file

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// Throws InputError on an unknown name or dimensions that make no body.
  BodyPatch
  create_body(const BodyParameters &parameters);

  /// A surface or outline by the name of its shape.
  struct CurveParameters
  {
    /// disk, cylinder, hemi-ellipsoid, subumbrella, sphere, spheroid, torus or
    /// file.
    std::string    shape          = "sphere";
    double         axial_position = 0.; ///< y of the reference point, m
    Discretization discretization;
    double         radius = 0.01;     ///< disk, cylinder, sphere; radial half
                                      ///< axis of (hemi-)ellipsoids, m
    double      half_height = 0.01;   ///< axial half axis, m
    double      flap_length = 0.0021; ///< subumbrella, m
    double      length      = 0.02;   ///< cylinder, m
    double      ring_radius = 0.02;   ///< torus, m
    double      core_radius = 0.005;  ///< torus, m
    std::string file_name;            ///< file

    static void
    declare(ParameterHandler &prm);
    void
    parse(ParameterHandler &prm);
  };

  /// Throws InputError on an unknown name or dimensions that make no curve.
  BodyCurve
  create_curve(const CurveParameters &parameters);
} // namespace ephyra::geometry
