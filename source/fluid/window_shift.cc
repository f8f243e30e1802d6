// The flow solver's part of a moving window: fields shifted along y.
#include "ephyra/base/timer_tree.h"
#include "ephyra/fluid/flow_diagnostics.h"
#include "ephyra/fluid/flow_solver.h"

#include <algorithm>
#include <cstring>

namespace ephyra::fluid
{
  namespace
  {
    /// Columns [begin, end) of a row hold values. Moves them down by @p shift
    /// columns (up where negative) and continues the last value into the
    /// columns that become free; returns those, [first, second).
    std::pair<int, int>
    shift_row(double *const row,
              const int     begin,
              const int     end,
              const int     shift)
    {
      const int n    = end - begin;
      const int kept = std::max(0, n - std::abs(shift));
      if (shift > 0)
        {
          const double last = row[end - 1];
          std::memmove(
            row + begin, row + begin + (n - kept), kept * sizeof(double));
          std::fill(row + begin + kept, row + end, last);
          return {begin + kept, end};
        }
      const double first = row[begin];
      std::memmove(
        row + begin + (n - kept), row + begin, kept * sizeof(double));
      std::fill(row + begin, row + end - kept, first);
      return {begin, end - kept};
    }
  } // namespace

  void
  FlowSolver::shift_window(const int n)
  {
    if (n == 0)
      return;
    const TimerTree::Scope scope(timer(), "window", n_cells());
    if (budget)
      budget->add_window(-kinetic_energy(current, parameters.density));
    the_grid.shift_y(n);
    boundary.forget_values();

    const GridLine &r = the_grid.r, &y = the_grid.y;
    const int       end_row       = the_grid.end_row();
    const bool      keeps_history = parameters.scheme == TimeScheme::ab2;
    // The radial velocity has one row more, the face of the outer side.
    for (int i = the_grid.first_row;
         i < end_row + (the_grid.is_last_rank() ? 1 : 0);
         ++i)
      {
        const auto fresh = shift_row(current.r.row(i), 0, y.n_cells, n);
        for (int j = fresh.first; i > 0 && j < fresh.second; ++j)
          current.r(i, j) = initial_radial(r.face[i], y.centre[j]);
        if (keeps_history)
          shift_row(history.r.row(i), 0, y.n_cells, n);
      }
    for (int i = the_grid.first_row; i < end_row; ++i)
      {
        const auto fresh = shift_row(current.y.row(i), 0, y.n_cells + 1, n);
        for (int j = fresh.first; j < fresh.second; ++j)
          current.y(i, j) = initial_axial(r.centre[i], y.face[j]);
        shift_row(new_pressure.row(i), 0, y.n_cells, n);
        if (keeps_history) // not of faces with a given velocity
          shift_row(history.y.row(i),
                    boundary.first_y_face(),
                    boundary.end_y_face(),
                    n);
      }

    boundary.set_time(time);
    boundary.set_normal_velocities(current, 0., current);
    update_ghosts();
    make_divergence_free(current, 1., nullptr);
    update_ghosts();
    if (budget)
      budget->add_window(kinetic_energy(current, parameters.density));
    new_pressure.exchange_halo();
    boundary.fill_pressure_ghosts(new_pressure);
  }
} // namespace ephyra::fluid
