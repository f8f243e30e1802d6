#include "ephyra/electrophysiology/diffusion_stepper.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <algorithm>
#include <cmath>

namespace ephyra::electrophysiology
{
  using linear_algebra::NarrowBandMatrix;

  DiffusionStepper::DiffusionStepper(const MonodomainOperator &monodomain,
                                     const BoundaryCondition::Parameters &start,
                                     const BoundaryCondition::Parameters &end,
                                     const double                         kappa,
                                     const LinearSolver linear_solver,
                                     const MPI_Comm     comm)
    : monodomain(monodomain)
    , start(start)
    , end(end)
    , kappa(kappa)
    , matrix(monodomain.n_unknowns(), monodomain.mass().half_bandwidth())
    , part_v(monodomain.n_unknowns())
    , part_increment(monodomain.n_unknowns())
  {
    EphyraThrowIf(monodomain.closed() &&
                    (start.holds_potential || end.holds_potential),
                  InputError,
                  "The line of the tissue is closed and has no end whose "
                  "potential could be held; set Type = no flux at both ends.");
    if (linear_solver == LinearSolver::narrow_band)
      return;
    using linear_algebra::SparseMatrix;
    const int                       n = matrix.n_rows();
    linear_algebra::SparsityPattern pattern(n);
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - matrix.half_bandwidth());
           j <= std::min(n - 1, i + matrix.half_bandwidth());
           ++j)
        pattern.columns[i].push_back(j);
    sparse = linear_solver == LinearSolver::amesos2
               ? std::make_unique<SparseMatrix>(
                   pattern, SparseMatrix::Storage::tpetra, comm)
               : std::make_unique<SparseMatrix>(
                   pattern, SparseMatrix::Storage::band, MPI_COMM_SELF);
    direct = linear_algebra::make_direct_solver(sparse->storage(),
                                                "monodomain matrix");
  }

  void
  DiffusionStepper::factorize()
  {
    if (!direct)
      {
        system.factorize(matrix, "monodomain matrix");
        return;
      }
    const MPI_Comm comm = sparse->communicator();
    const auto     rows =
      mpi::share(matrix.n_rows(), mpi::rank(comm), mpi::size(comm));
    sparse->begin_assembly();
    for (int i = rows.first; i < rows.first + rows.count; ++i)
      for (int j = std::max(0, i - matrix.half_bandwidth());
           j <= std::min(matrix.n_rows() - 1, i + matrix.half_bandwidth());
           ++j)
        sparse->add(i, j, matrix(i, j));
    sparse->finish_assembly();
    direct->factorize(*sparse);
  }

  void
  DiffusionStepper::solve_system(std::vector<double> &x)
  {
    if (!direct)
      {
        system.solve(x.data());
        return;
      }
    right_hand_side = x;
    direct->solve(right_hand_side, x);
  }

  void
  DiffusionStepper::prepare_matrix(const double dt,
                                   const bool   hold_start,
                                   const bool   hold_end)
  {
    // Sums of times make steps differ in their last digits.
    if (std::abs(dt - factorized_dt) < 1e-9 * dt && hold_start == start_held &&
        hold_end == end_held)
      return;
    const NarrowBandMatrix &mass      = monodomain.mass();
    const NarrowBandMatrix &stiffness = monodomain.stiffness();
    const int               n         = matrix.n_rows();
    const int               width     = matrix.half_bandwidth();
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - width); j <= std::min(n - 1, i + width); ++j)
        {
          const bool held = (i == 0 && hold_start) || (i == n - 1 && hold_end);
          matrix(i, j)    = held ? (i == j ? 1. : 0.)
                                 : mass(i, j) + 0.5 * dt * kappa * stiffness(i, j);
        }
    factorize();
    ++factorizations;
    if (monodomain.closed())
      {
        seam.assign(n, 0.);
        seam[0]     = 1.;
        seam[n - 1] = -1.;
        solve_system(seam);
      }
    factorized_dt = dt;
    start_held    = hold_start;
    end_held      = hold_end;
  }

  void
  DiffusionStepper::solve(const double               t,
                          const double               dt,
                          const std::vector<double> &load,
                          const std::vector<double> &v,
                          std::vector<double>       &increment)
  {
    const bool hold_start = start.holds(t, dt);
    const bool hold_end   = end.holds(t, dt);
    if ((hold_start && !start_held) || (hold_end && !end_held))
      damped_steps = damped_steps_after_jump;
    prepare_matrix(dt, hold_start, hold_end);

    const int    n       = matrix.n_rows();
    const int    n_parts = damped_steps > 0 ? 2 : 1;
    const double part    = dt / n_parts;
    std::fill(increment.begin(), increment.end(), 0.);
    part_v = v;
    for (int k = 1; k <= n_parts; ++k)
      {
        for (int i = 0; i < n; ++i)
          part_increment[i] = part * load[i];
        monodomain.stiffness().add_multiply(
          part_v.data(), part_increment.data(), -part * kappa);
        if (hold_start)
          part_increment[0] = start.held_potential(t + k * part) - part_v[0];
        if (hold_end)
          part_increment[n - 1] =
            end.held_potential(t + k * part) - part_v[n - 1];
        solve_system(part_increment);
        if (monodomain.closed())
          {
            const double lambda = (part_increment[0] - part_increment[n - 1]) /
                                  (seam[0] - seam[n - 1]);
            for (int i = 0; i < n; ++i)
              part_increment[i] -= lambda * seam[i];
            part_increment[n - 1] = part_increment[0];
          }
        for (int i = 0; i < n; ++i)
          {
            part_v[i] += part_increment[i];
            increment[i] += part_increment[i];
          }
      }
  }

  void
  DiffusionStepper::finish_step()
  {
    damped_steps = std::max<std::int64_t>(0, damped_steps - 1);
  }

  void
  DiffusionStepper::matrices_changed()
  {
    factorized_dt = 0;
  }

  double
  DiffusionStepper::next_event(const double t) const
  {
    return std::min(start.next_event(t), end.next_event(t));
  }

  void
  DiffusionStepper::serialize(Archive &archive)
  {
    const Archive::Group group(archive, "diffusion");
    double               dt         = factorized_dt;
    std::int64_t         hold_start = start_held, hold_end = end_held;
    archive.value("factorised step", dt);
    archive.value("start held", hold_start);
    archive.value("end held", hold_end);
    archive.value("damped steps", damped_steps);
    if (archive.reading())
      {
        factorized_dt = 0;
        if (dt > 0)
          prepare_matrix(dt, hold_start != 0, hold_end != 0);
      }
  }
} // namespace ephyra::electrophysiology
