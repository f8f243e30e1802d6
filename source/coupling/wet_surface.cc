#include "ephyra/coupling/wet_surface.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"
#include "ephyra/immersed_boundary/no_slip_iteration.h"
#include "ephyra/splines/control_vector.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ephyra::coupling
{
  namespace
  {
    using immersed_boundary::Markers;

    /// Markers further apart than this many cells do not share nodes of the
    /// flow in one forcing sweep (their stencils are three cells wide); the
    /// rest is a margin for repeated sweeps and deformation.
    constexpr double coupling_reach = 4.5;

    /// Times the largest marker spacing: no smooth motion comes as far in a
    /// step.
    constexpr double beyond_repair = 2;

    std::vector<immersed_boundary::BoundaryCurve>
    curves(const splines::NurbsPatch<2>     &patch,
           const std::vector<splines::Side> &sides)
    {
      return immersed_boundary::patch_outline(patch, sides, "body").curves;
    }

    using MapVector = Eigen::Map<const Eigen::VectorXd>;

    MapVector
    component(const std::vector<double> &marker_vector, const int c)
    {
      const auto n = static_cast<Eigen::Index>(marker_vector.size() / 2);
      return MapVector(marker_vector.data() + c * n, n);
    }
  } // namespace

  WetSurface::WetSurface(const immersed_boundary::Parameters &parameters,
                         const splines::NurbsPatch<2>        &patch,
                         const std::vector<splines::Side>    &wet_sides,
                         const fluid::FlowSolver             &flow)
    : parameters(parameters)
    , patch(patch)
    , wet_sides(wet_sides)
    , grid(flow.grid())
    , density(flow.density())
    , the_markers(std::make_unique<Markers>(curves(patch, wet_sides),
                                            splines::control_vector(patch),
                                            flow.grid(),
                                            parameters))
    , forcing(std::make_unique<immersed_boundary::DirectForcing>(flow.grid(),
                                                                 parameters))
    , surface_loads(std::make_unique<immersed_boundary::SurfaceLoads>(
        flow.grid(), flow.density(), flow.viscosity(), parameters))
    , n_control_points(patch.n_control_points())
    , shapes{splines::control_vector(patch)}
  {
    log().line("Immersed boundary: " + parameters.description() + ", " +
               std::to_string(the_markers->size()) + " markers.");
    assemble_shape();
    const std::vector<double> rest(2 * n_control_points, 0.);
    set_geometry({splines::control_vector(patch), rest, rest});
  }

  void
  WetSurface::prepare_fluid_load(const fluid::FlowSolver &flow)
  {
    using immersed_boundary::Load;
    const bool several = flow.n_stages() != 1;
    EphyraThrowIf(parameters.load == Load::forcing && several,
                  InputError,
                  "Immersed boundary/Load = forcing needs a flow with one "
                  "projection a step; set Fluid/Time scheme = ab2 or Load = "
                  "probes.");
    if (parameters.load == Load::automatic)
      log().line(std::string("Load of the flow: ") +
                 (several ? "probes (the flow has several stages)"
                          : "forcing (the flow has one projection a step)"));
    if (parameters.load == Load::probes || several)
      return;
    interior = std::make_unique<immersed_boundary::InteriorFluid>(
      patch, flow.grid(), flow.density(), flow.viscosity(), parameters);
    interior->update(frozen_position);
    assemble_to_surface();
  }

  void
  WetSurface::assemble_shape()
  {
    const auto &rows = the_markers->shape();
    shape.resize(rows.n_rows(), n_control_points);
    std::vector<Eigen::Triplet<double>> entries;
    for (int l = 0; l < rows.n_rows(); ++l)
      for (int k = rows.start[l]; k < rows.start[l + 1]; ++k)
        entries.emplace_back(l, rows.column[k], rows.value[k]);
    shape.setFromTriplets(entries.begin(), entries.end());
  }

  void
  WetSurface::place_markers()
  {
    the_markers->distribute(shapes, grid);
    assemble_shape();
  }

  void
  WetSurface::follow_stretch(const BodyMotion &motion)
  {
    const double spacing = the_markers->largest_spacing(grid);
    if (spacing <= parameters.largest_spacing ||
        spacing > beyond_repair * parameters.largest_spacing)
      return;
    the_markers->check_inside(grid);
    const int before = the_markers->size();
    shapes.push_back(motion.position);
    place_markers();
    the_markers->move(motion.position, motion.velocity, motion.acceleration);
    std::ostringstream line;
    line << "Body: markers " << spacing << " cells apart are placed anew, "
         << the_markers->size() << " instead of " << before;
    log().line(line.str());
  }

  void
  WetSurface::serialize(Archive &archive)
  {
    auto n = static_cast<std::int64_t>(shapes.size());
    archive.value("number of shapes", n);
    const bool changed = n != static_cast<std::int64_t>(shapes.size());
    shapes.resize(n);
    for (std::size_t k = 1; k < shapes.size(); ++k)
      archive.values("shape " + std::to_string(k), shapes[k]);
    if (changed)
      place_markers();
  }

  void
  WetSurface::assemble_to_surface()
  {
    using splines::Side;
    const auto has = [this](const Side side) {
      return std::find(wet_sides.begin(), wet_sides.end(), side) !=
             wet_sides.end();
    };
    const bool                          lower = has(Side::theta2_0);
    const bool                          upper = has(Side::theta2_1);
    const int                           n     = patch.n_basis(1);
    const std::vector<double>           xi    = patch.knot_vector(1).greville();
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < patch.n_basis(0); ++i)
      for (int j = 0; j < n; ++j)
        {
          const double share = lower && upper ? xi[j] : upper ? 1. : 0.;
          if (lower && share < 1.)
            entries.emplace_back(i * n, i * n + j, 1. - share);
          if (upper && share > 0.)
            entries.emplace_back(i * n + n - 1, i * n + j, share);
          if (!lower && !upper)
            entries.emplace_back(i * n + j, i * n + j, 1.);
        }
    to_surface.resize(n_control_points, n_control_points);
    to_surface.setFromTriplets(entries.begin(), entries.end());
  }

  void
  WetSurface::begin_step(const BodyMotion &start, const fluid::FlowSolver &flow)
  {
    if (!interior)
      return;
    interior->update(start.position);
    interior->start(flow.velocity());
  }

  void
  WetSurface::set_geometry(const BodyMotion &motion)
  {
    frozen_position = motion.position;
    the_markers->move(motion.position, motion.velocity, motion.acceleration);
    follow_stretch(motion);
    forcing->update(*the_markers);
    if (interior)
      interior->update(motion.position);
  }

  void
  WetSurface::set_motion(const BodyMotion &motion)
  {
    the_markers->move(frozen_position, motion.velocity, motion.acceleration);
  }

  void
  WetSurface::sample(const fluid::FlowSolver &flow, const unsigned int stage)
  {
    forcing->prepare(flow, stage);
    forcing->interpolate(flow.velocity(), Ju);
  }

  std::vector<double>
  WetSurface::target() const
  {
    const auto         &state = the_markers->state();
    std::vector<double> V(state.v_r);
    V.insert(V.end(), state.v_y.begin(), state.v_y.end());
    return V;
  }

  void
  WetSurface::solve_forcing()
  {
    std::vector<double> residual = target();
    for (std::size_t l = 0; l < residual.size(); ++l)
      residual[l] -= Ju[l];
    forcing->solve(residual, F);
  }

  StepStatus
  WetSurface::force_and_project(fluid::FlowSolver &flow,
                                const unsigned int stage)
  {
    if (parameters.no_slip_iterations > 0)
      return immersed_boundary::converge_no_slip(flow,
                                                 stage,
                                                 *forcing,
                                                 target(),
                                                 parameters.no_slip_tolerance,
                                                 parameters.no_slip_iterations,
                                                 F);
    forcing->add(F, flow, stage);
    flow.project(stage);
    return {};
  }

  double
  WetSurface::forcing_work(const fluid::VelocityField &before,
                           const fluid::VelocityField &after) const
  {
    return density * forcing->work(F, before, after);
  }

  void
  WetSurface::add_forcing_load(const double dt, std::vector<double> &load) const
  {
    const auto           &w = forcing->impulse_weights();
    const Eigen::VectorXd weights =
      MapVector(w.data(), static_cast<Eigen::Index>(w.size())) *
      (-density / dt);
    for (int c = 0; c < 2; ++c)
      {
        const Eigen::VectorXd nodal =
          shape.transpose() * weights.cwiseProduct(component(F, c));
        for (int i = 0; i < n_control_points; ++i)
          load[2 * i + c] += nodal[i];
      }
  }

  WetSurface::Matrix
  WetSurface::forcing_resistance(const double dt) const
  {
    const auto           &w = forcing->impulse_weights();
    const Eigen::VectorXd weights =
      MapVector(w.data(), static_cast<Eigen::Index>(w.size())) * (density / dt);
    const Matrix weighted_transpose =
      Matrix(shape.transpose()) * weights.asDiagonal();

    std::vector<Eigen::Triplet<double>> entries;
    for (int c = 0; c < 2; ++c)
      {
        const Matrix K = weighted_transpose * forcing->forces(c, shape);
        for (int i = 0; i < K.outerSize(); ++i)
          for (Matrix::InnerIterator entry(K, i); entry; ++entry)
            entries.emplace_back(
              2 * i + c, 2 * static_cast<int>(entry.col()) + c, entry.value());
      }
    Matrix result(2 * n_control_points, 2 * n_control_points);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  void
  WetSurface::evaluate_loads(const fluid::FlowSolver &flow)
  {
    surface_loads->update(*the_markers);
    surface_loads->evaluate(*the_markers, flow.pressure(), flow.velocity());
  }

  void
  WetSurface::probe_load(const fluid::FlowSolver &flow,
                         std::vector<double>     &load)
  {
    evaluate_loads(flow);

    the_markers->to_control_points(surface_loads->marker_forces(*the_markers),
                                   load);
  }

  void
  WetSurface::fluid_load(const fluid::FlowSolver &flow,
                         const double             dt,
                         std::vector<double>     &load)
  {
    if (!interior)
      return probe_load(flow, load);
    std::fill(load.begin(), load.end(), 0.);
    add_forcing_load(dt, load);
    std::vector<double> inside(load.size(), 0.);
    interior->add_load(dt, flow.pressure(), flow.velocity(), inside);
    const Eigen::Map<
      const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>
      volume(inside.data(), n_control_points, 2);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>(
      load.data(), n_control_points, 2) += to_surface * volume;
  }

  double
  WetSurface::roughness(const std::vector<double> &load) const
  {
    std::vector<double> area(n_control_points, 0.);
    const auto         &state = the_markers->state();
    for (int l = 0; l < the_markers->size(); ++l)
      for (Matrix::InnerIterator R(shape, l); R; ++R)
        area[R.col()] += R.value() * 2. * M_PI * state.r[l] * state.length[l];
    double rough = 0., size = 0.;
    for (const auto &curve : the_markers->curves())
      for (std::size_t k = 1; k + 1 < curve.control_points.size(); ++k)
        for (int c = 0; c < 2; ++c)
          {
            const auto traction = [&](const std::size_t at) {
              const int i = curve.control_points[at];
              return load[2 * i + c] / area[i];
            };
            rough +=
              std::pow(traction(k - 1) - 2. * traction(k) + traction(k + 1), 2);
            size += std::pow(traction(k), 2);
          }
    return size > 0. ? 0.25 * std::sqrt(rough / size) : 0.;
  }

  linear_algebra::SparsityPattern
  WetSurface::coupling_pattern(const bool implicit_viscosity) const
  {
    linear_algebra::SparsityPattern pattern(2 * n_control_points);
    if (implicit_viscosity)
      {
        std::vector<int> wet;
        for (const auto &curve : the_markers->curves())
          for (const int point : curve.control_points)
            wet.insert(wet.end(), {2 * point, 2 * point + 1});
        for (const int i : wet)
          pattern.columns[i] = wet;
        pattern.compress();
        return pattern;
      }
    const auto &state = the_markers->state();
    const auto &rows  = the_markers->shape();
    const int   n     = the_markers->size();
    for (int l = 0; l < n; ++l)
      for (int m = 0; m <= l; ++m)
        if (immersed_boundary::length_in_cells(grid,
                                               state.r[l],
                                               state.y[l],
                                               state.r[m] - state.r[l],
                                               state.y[m] - state.y[l]) <
            coupling_reach)
          for (int a = rows.start[l]; a < rows.start[l + 1]; ++a)
            for (int b = rows.start[m]; b < rows.start[m + 1]; ++b)
              for (int c = 0; c < 2; ++c)
                {
                  const int i = 2 * rows.column[a] + c;
                  const int j = 2 * rows.column[b] + c;
                  pattern.columns[i].push_back(j);
                  pattern.columns[j].push_back(i);
                }
    pattern.compress();
    return pattern;
  }

  double
  WetSurface::slip(const fluid::VelocityField &velocity) const
  {
    std::vector<double> u;
    forcing->interpolate(velocity, u);
    const auto       &state = the_markers->state();
    const std::size_t n     = state.r.size();
    double            error = 0, size = 0;
    for (std::size_t l = 0; l < n; ++l)
      {
        error += std::pow(u[l] - state.v_r[l], 2) +
                 std::pow(u[n + l] - state.v_y[l], 2);
        size += std::pow(state.v_r[l], 2) + std::pow(state.v_y[l], 2);
      }
    return size > 0 ? std::sqrt(error / size) : 0.;
  }

  double
  WetSurface::largest_spacing() const
  {
    return the_markers->largest_spacing(grid);
  }
} // namespace ephyra::coupling
