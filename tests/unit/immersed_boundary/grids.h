#pragma once

#include "ephyra/fluid/velocity_field.h"
#include "ephyra/geometry/simple_bodies.h"
#include "ephyra/geometry/simple_curves.h"
#include "ephyra/immersed_boundary/boundary_curve.h"

#include <cmath>
#include <vector>

namespace ephyra::test
{
  /// Faces of n cells on [begin, end] whose width varies smoothly by the given
  /// amplitude.
  inline fluid::GridLine
  line(const int    n,
       const double begin,
       const double end,
       const double amplitude = 0)
  {
    std::vector<double> face(n + 1);
    for (int i = 0; i <= n; ++i)
      {
        const double s = static_cast<double>(i) / n;
        face[i] =
          begin +
          (end - begin) * (s - amplitude * std::sin(2 * M_PI * s) / (2 * M_PI));
      }
    return fluid::GridLine(face);
  }

  inline geometry::Discretization
  coarse()
  {
    geometry::Discretization d;
    d.degree     = {2, 2};
    d.n_elements = {4, 1};
    return d;
  }
  inline immersed_boundary::Outline
  spheroid(const double a, const double b, const std::string &name)
  {
    return immersed_boundary::curve_outline(
      geometry::make_spheroid(a, b, 0., coarse()), name);
  }
  inline immersed_boundary::Outline
  torus(const double       ring_radius,
        const double       core_radius,
        const std::string &name)
  {
    return immersed_boundary::curve_outline(
      geometry::make_torus(ring_radius, core_radius, 0., coarse()), name);
  }
  inline immersed_boundary::Outline
  disk(const double radius, const double thickness, const std::string &name)
  {
    return immersed_boundary::body_outline(
      geometry::make_disk(radius, thickness, 0., coarse()), name);
  }

  /// Sets the rows held here, the wall rows and columns included.
  template <class R, class Y>
  void
  fill(fluid::VelocityField &u, const R &u_r, const Y &u_y)
  {
    const fluid::StaggeredGrid &g = u.grid();
    for (int i = g.first_row; i < g.end_row() + 1; ++i)
      for (int j = 0; j <= g.y.n_cells; ++j)
        {
          if ((i < g.end_row() || g.is_last_rank()) && j < g.y.n_cells)
            u.r(i, j) = u_r(g.r.face[i], g.y.centre[j]);
          if (i < g.end_row())
            u.y(i, j) = u_y(g.r.centre[i], g.y.face[j]);
        }
  }

  /// Sets the cells held here.
  template <class P>
  void
  fill_cells(fluid::DistributedArray &p, const P &value)
  {
    const fluid::StaggeredGrid &g = p.grid();
    for (int i = g.first_row; i < g.end_row(); ++i)
      for (int j = 0; j < g.y.n_cells; ++j)
        p(i, j) = value(g.r.centre[i], g.y.centre[j]);
  }
} // namespace ephyra::test
