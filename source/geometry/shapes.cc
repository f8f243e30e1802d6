#include "ephyra/geometry/shapes.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/geometry/patch_file.h"
#include "ephyra/geometry/simple_bodies.h"
#include "ephyra/geometry/simple_curves.h"

namespace ephyra::geometry
{
  namespace
  {
    void
    declare_length(ParameterHandler  &prm,
                   const std::string &name,
                   const std::string &value,
                   const std::string &text)
    {
      prm.declare_entry(name, value, patterns::Positive("m"), text);
    }

    void
    declare_common(ParameterHandler  &prm,
                   const std::string &shapes,
                   const std::string &shape,
                   const int          dim)
    {
      prm.declare_entry("Shape",
                        shape,
                        patterns::Selection(shapes),
                        "Name of the shape; its dimensions follow below, those "
                        "of other shapes are ignored.");
      prm.declare_entry("Axial position",
                        "0 m",
                        patterns::Double("m"),
                        "Height y of the reference point of the shape: apex of "
                        "a bell, centre of spheres, spheroids and tori, lower "
                        "end of tubes, rods, cylinders and disks, y = 0 of a "
                        "patch from a file.");
      Discretization::declare(prm, dim);
      prm.declare_entry("Patch file",
                        "",
                        patterns::Anything(),
                        "File of control points, for the shape 'file'.");
    }

    PatchFile
    read_shifted(const std::string &file_name,
                 const int          dimension,
                 const double       shift)
    {
      PatchFile file = read_patch_file(file_name);
      EphyraThrowIf(file.dimension != dimension,
                    InputError,
                    "The patch file '"
                      << file_name << "' holds a patch of dimension "
                      << file.dimension << ", but one of dimension "
                      << dimension << " is needed here.");
      for (Point &x : file.points)
        x.y += shift;
      return file;
    }
  } // namespace

  void
  BodyParameters::declare(ParameterHandler &prm)
  {
    declare_common(prm, "bell|tube|rod|disk|hollow sphere|file", "bell", 2);
    declare_length(prm, "Radius", "10 mm", "Radius of a rod or disk.");
    declare_length(
      prm, "Inner radius", "5 mm", "Inner radius of a tube or hollow sphere.");
    declare_length(
      prm, "Outer radius", "10 mm", "Outer radius of a tube or hollow sphere.");
    declare_length(prm, "Length", "20 mm", "Length of a tube or rod.");
    declare_length(prm, "Thickness", "1 mm", "Thickness of a disk.");
    prm.declare_entry("Section",
                      "half",
                      patterns::Selection("quarter|half"),
                      "Part of a hollow sphere: 'half' is the whole sphere, "
                      "'quarter' ends at a plane of symmetry.");
    const ParameterHandler::Section in_bell(prm, "Bell");
    BellParameters::declare(prm);
  }

  void
  BodyParameters::parse(ParameterHandler &prm)
  {
    shape          = prm.get("Shape");
    axial_position = prm.get_double("Axial position");
    discretization.parse(prm, 2);
    file_name    = prm.get("Patch file");
    radius       = prm.get_double("Radius");
    inner_radius = prm.get_double("Inner radius");
    outer_radius = prm.get_double("Outer radius");
    length       = prm.get_double("Length");
    thickness    = prm.get_double("Thickness");
    section      = prm.get("Section");
    const ParameterHandler::Section in_bell(prm, "Bell");
    bell.parse(prm);
  }

  BodyPatch
  create_body(const BodyParameters &p)
  {
    const double          y = p.axial_position;
    const Discretization &d = p.discretization;
    if (p.shape == "bell")
      return make_bell(p.bell, y, d);
    if (p.shape == "tube")
      return make_tube(p.inner_radius, p.outer_radius, p.length, y, d);
    if (p.shape == "rod")
      return make_tube(0., p.radius, p.length, y, d);
    if (p.shape == "disk")
      return make_disk(p.radius, p.thickness, y, d);
    if (p.shape == "hollow sphere")
      return make_hollow_sphere(p.inner_radius,
                                p.outer_radius,
                                p.section == "quarter" ? SphereSection::quarter
                                                       : SphereSection::half,
                                y,
                                d);
    EphyraThrowIf(p.shape != "file",
                  InputError,
                  "There is no body of the shape '"
                    << p.shape << "'; shapes are bell, tube, rod, disk, hollow "
                    << "sphere and file.");
    const PatchFile file = read_shifted(p.file_name, 2, y);
    return make_body(
      p.file_name,
      refined(NurbsPatch<2>(file.knot_vectors, file.points, file.weights),
              d,
              p.file_name),
      file.dry);
  }

  void
  CurveParameters::declare(ParameterHandler &prm)
  {
    declare_common(prm,
                   "disk|cylinder|hemi-ellipsoid|subumbrella|sphere|spheroid|"
                   "torus|file",
                   "sphere",
                   1);
    declare_length(prm,
                   "Radius",
                   "10 mm",
                   "Radius of a disk, cylinder or sphere, or radial half axis "
                   "of a spheroid, hemi-ellipsoid or subumbrella.");
    declare_length(prm,
                   "Half height",
                   "10 mm",
                   "Axial half axis of a spheroid, hemi-ellipsoid or "
                   "subumbrella.");
    declare_length(prm,
                   "Flap length",
                   "2.1 mm",
                   "Length of the flap that a subumbrella has below its "
                   "ellipse.");
    declare_length(prm, "Length", "20 mm", "Length of a cylinder.");
    declare_length(prm,
                   "Ring radius",
                   "20 mm",
                   "Distance of the core of a torus from the axis.");
    declare_length(
      prm, "Core radius", "5 mm", "Radius of the core of a torus.");
  }

  void
  CurveParameters::parse(ParameterHandler &prm)
  {
    shape          = prm.get("Shape");
    axial_position = prm.get_double("Axial position");
    discretization.parse(prm, 1);
    file_name   = prm.get("Patch file");
    radius      = prm.get_double("Radius");
    half_height = prm.get_double("Half height");
    flap_length = prm.get_double("Flap length");
    length      = prm.get_double("Length");
    ring_radius = prm.get_double("Ring radius");
    core_radius = prm.get_double("Core radius");
  }

  BodyCurve
  create_curve(const CurveParameters &p)
  {
    const double          y = p.axial_position;
    const Discretization &d = p.discretization;
    if (p.shape == "disk")
      return make_disk_surface(p.radius, y, d);
    if (p.shape == "cylinder")
      return make_cylinder_surface(p.radius, p.length, y, d);
    if (p.shape == "hemi-ellipsoid")
      return make_hemi_ellipsoid(p.radius, p.half_height, y, d);
    if (p.shape == "subumbrella")
      return make_subumbrella(p.radius, p.half_height, p.flap_length, y, d);
    if (p.shape == "sphere")
      return make_spheroid(p.radius, p.radius, y, d);
    if (p.shape == "spheroid")
      return make_spheroid(p.radius, p.half_height, y, d);
    if (p.shape == "torus")
      return make_torus(p.ring_radius, p.core_radius, y, d);
    EphyraThrowIf(p.shape != "file",
                  InputError,
                  "There is no curve of the shape '"
                    << p.shape << "'; shapes are disk, cylinder, "
                    << "hemi-ellipsoid, subumbrella, sphere, spheroid, torus "
                    << "and file.");
    const PatchFile file = read_shifted(p.file_name, 1, y);
    return {p.file_name,
            refined(NurbsPatch<1>(file.knot_vectors, file.points, file.weights),
                    d,
                    p.file_name),
            file.reversed,
            file.closed};
  }
} // namespace ephyra::geometry
