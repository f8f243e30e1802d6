#include "ephyra/fluid/stretched_ends.h"

#include <algorithm>
#include <cmath>

namespace ephyra::fluid
{
  StretchedEnds::StretchedEnds(const StaggeredGrid &grid,
                               const PoissonSides  &sides,
                               const mpi::Share    &block)
    : grid(grid)
    , n_lower(block.first)
    , n_upper(grid.y.n_cells - block.first - block.count)
    , n_block(block.count)
    , radial(grid, sides.outer_dirichlet)
    , own_modes(mpi::share(radial.n,
                           mpi::rank(grid.communicator()),
                           mpi::size(grid.communicator())))
    , modes(static_cast<std::size_t>(n_lower + n_upper) * own_modes.count)
    , face_modes(2 * radial.n)
    , face_values(2 * own_modes.count)
  {
    set_up_end(lower, 0, 1, n_lower, 0, sides.lower_dirichlet);
    set_up_end(upper,
               grid.y.n_cells - 1,
               -1,
               n_upper,
               n_lower + n_upper - 1,
               sides.upper_dirichlet);
    const double begin = grid.y.face[block.first];
    const double end   = grid.y.face[block.first + block.count];
    set_up_block((end - begin) / n_block, sides);

    const MPI_Comm comm    = grid.communicator();
    const int      n_ranks = mpi::size(comm);
    if (n_ranks == 1)
      return;
    transposition = std::make_unique<Transposition>(radial.n, n_cells(), comm);
    const int own = transposition->columns.count;
    columns.resize(static_cast<std::size_t>(own) * radial.n);
    column_modes.resize(columns.size());
    message.resize(columns.size());
    int sent = 0, received = 0;
    for (int q = 0; q < n_ranks; ++q)
      {
        send_count.push_back(own * mpi::share(radial.n, q, n_ranks).count);
        send_offset.push_back(sent);
        sent += send_count[q];
        receive_count.push_back(own_modes.count *
                                mpi::share(n_cells(), q, n_ranks).count);
        receive_offset.push_back(received);
        received += receive_count[q];
      }
  }

  void
  StretchedEnds::set_up_end(End       &end,
                            const int  first_cell,
                            const int  direction,
                            const int  n_cells,
                            const int  first_column,
                            const bool dirichlet)
  {
    // `e` starts with the conductance to the side of the domain.
    const GridLine     &y = grid.y;
    std::vector<double> e(own_modes.count, 0.);
    end.inverse.resize(static_cast<std::size_t>(n_cells) * own_modes.count);
    for (int s = 0; s < n_cells; ++s)
      {
        const int j    = first_cell + direction * s;
        const int face = direction > 0 ? j + 1 : j;
        end.column.push_back(first_column + direction * s);
        // The face of the block is half a cell away.
        end.ahead.push_back(s == n_cells - 1 ? 2. / y.width[j]
                                             : 1. / y.centre_gap[face]);
        for (int k = 0; k < own_modes.count; ++k)
          {
            double behind = dirichlet ? 2. / y.width[j] : 0.;
            if (s > 0)
              behind = end.ahead[s - 1] * e[k] / (end.ahead[s - 1] + e[k]);
            e[k] =
              radial.eigenvalues[own_modes.first + k] * y.width[j] + behind;
            end.inverse[static_cast<std::size_t>(s) * own_modes.count + k] =
              1. / (end.ahead[s] + e[k]);
          }
      }
    end.response.assign(own_modes.count, 0.);
    if (n_cells > 0)
      for (int k = 0; k < own_modes.count; ++k)
        end.response[k] = end.ahead.back() * e[k] / (end.ahead.back() + e[k]);
  }

  void
  StretchedEnds::set_up_block(const double h, const PoissonSides &sides)
  {
    // Solutions are sinh and cosh of (j + 1/2) t with 2 sinh(t/2) = h
    // sqrt(lambda).
    const bool both = n_lower > 0 && n_upper > 0;
    const bool wall =
      !both && !(n_lower > 0 ? sides.upper_dirichlet : sides.lower_dirichlet);
    for (int k = 0; k < own_modes.count; ++k)
      {
        const double lambda = radial.eigenvalues[own_modes.first + k];
        const double t      = 2 * std::asinh(0.5 * h * std::sqrt(lambda));
        const double unit   = 2. / h * std::tanh(0.5 * t);
        const double linear = 1. / (n_block * h);
        if (wall)
          near_response.push_back(unit * std::tanh(n_block * t));
        else
          near_response.push_back(lambda == 0 ? linear
                                              : unit / std::tanh(n_block * t));
        far_response.push_back(lambda == 0 ? linear
                                           : unit / std::sinh(n_block * t));
        determinant.push_back(unit * unit);
      }
  }

  void
  StretchedEnds::solve(double *const rows, double *const faces)
  {
    const MPI_Comm comm = grid.communicator();
    to_modes(rows);
    multiply('T',
             'N',
             radial.n,
             2,
             grid.n_rows,
             &radial.vectors[grid.first_row],
             radial.n,
             faces,
             grid.n_rows,
             face_modes.data(),
             radial.n);
    if (transposition != nullptr)
      mpi::sum_in_place(face_modes.data(), face_modes.size(), comm);
    double *const lower_face = face_values.data();
    double *const upper_face = lower_face + own_modes.count;
    std::copy_n(&face_modes[own_modes.first], own_modes.count, lower_face);
    std::copy_n(
      &face_modes[radial.n + own_modes.first], own_modes.count, upper_face);
    eliminate(lower, lower_face);
    eliminate(upper, upper_face);
    solve_faces(lower_face, upper_face);
    substitute(lower, lower_face);
    substitute(upper, upper_face);

    std::fill(face_modes.begin(), face_modes.end(), 0.);
    std::copy_n(lower_face, own_modes.count, &face_modes[own_modes.first]);
    std::copy_n(
      upper_face, own_modes.count, &face_modes[radial.n + own_modes.first]);
    if (transposition != nullptr)
      mpi::sum_in_place(face_modes.data(), face_modes.size(), comm);
    multiply('N',
             'N',
             grid.n_rows,
             2,
             radial.n,
             &radial.vectors[grid.first_row],
             radial.n,
             face_modes.data(),
             radial.n,
             faces,
             grid.n_rows);
    from_modes(rows);
    for (int i = 0; i < grid.n_rows; ++i)
      {
        const double  scale = 1. / radial.root_weight[grid.first_row + i];
        double *const row   = rows + static_cast<std::size_t>(i) * n_cells();
        for (int c = 0; c < n_cells(); ++c)
          row[c] *= scale;
        faces[i] *= scale;
        faces[grid.n_rows + i] *= scale;
      }
  }

  void
  StretchedEnds::eliminate(const End &end, double *const flux)
  {
    const int     n      = own_modes.count;
    const double *before = nullptr, *inverse = nullptr;
    for (std::size_t s = 0; s < end.column.size(); ++s)
      {
        double *const f = &modes[static_cast<std::size_t>(end.column[s]) * n];
        if (s > 0)
          for (int k = 0; k < n; ++k)
            f[k] += end.ahead[s - 1] * inverse[k] * before[k];
        before  = f;
        inverse = &end.inverse[s * n];
      }
    if (before != nullptr)
      for (int k = 0; k < n; ++k)
        flux[k] -= end.ahead.back() * inverse[k] * before[k];
  }

  void
  StretchedEnds::solve_faces(double *const lower_face, double *const upper_face)
  {
    // The sum of the fluxes of end and block out of each face is zero. Where
    // phi is determined up to a constant, its mode is zero on the upper face.
    const bool both = n_lower > 0 && n_upper > 0;
    for (int k = 0; k < own_modes.count; ++k)
      {
        const double f = lower_face[k], g = upper_face[k];
        const double near = near_response[k], far = far_response[k];
        const double d = lower.response[k], e = upper.response[k];
        if (both)
          {
            const double total = determinant[k] + near * (d + e) + d * e;
            lower_face[k] =
              total > 0 ? ((near + e) * f + far * g) / total : f / near;
            upper_face[k] = total > 0 ? ((near + d) * g + far * f) / total : 0.;
            continue;
          }
        const double total = near + (n_lower > 0 ? d : e);
        lower_face[k]      = n_lower > 0 && total > 0 ? f / total : 0.;
        upper_face[k]      = n_upper > 0 && total > 0 ? g / total : 0.;
      }
  }

  void
  StretchedEnds::substitute(const End &end, const double *const face)
  {
    const int     n     = own_modes.count;
    const double *after = face;
    for (std::size_t s = end.column.size(); s-- > 0;)
      {
        double *const x = &modes[static_cast<std::size_t>(end.column[s]) * n];
        const double *const inverse = &end.inverse[s * n];
        const double        a       = end.ahead[s];
        for (int k = 0; k < n; ++k)
          x[k] = (a * after[k] - x[k]) * inverse[k];
        after = x;
      }
  }

  void
  StretchedEnds::to_modes(const double *const rows)
  {
    const int n = radial.n;
    if (transposition == nullptr)
      {
        multiply('T',
                 'T',
                 n,
                 n_cells(),
                 n,
                 radial.vectors.data(),
                 n,
                 rows,
                 n_cells(),
                 modes.data(),
                 n);
        return;
      }
    const int own = transposition->columns.count;
    transposition->to_columns(rows, n_cells(), columns.data());
    multiply('T',
             'N',
             n,
             own,
             n,
             radial.vectors.data(),
             n,
             columns.data(),
             n,
             column_modes.data(),
             n);
    // To the owners of the modes, [own cell][mode of q] for each rank q.
    double *send = message.data();
    for_each_share([&](const mpi::Share &other) {
      for (int c = 0; c < own; ++c)
        send = std::copy_n(
          &column_modes[static_cast<std::size_t>(c) * n + other.first],
          other.count,
          send);
    });
    MPI_Alltoallv(message.data(),
                  send_count.data(),
                  send_offset.data(),
                  MPI_DOUBLE,
                  modes.data(),
                  receive_count.data(),
                  receive_offset.data(),
                  MPI_DOUBLE,
                  grid.communicator());
  }

  void
  StretchedEnds::from_modes(double *const rows)
  {
    const int n = radial.n;
    if (transposition == nullptr)
      {
        multiply('T',
                 'T',
                 n_cells(),
                 n,
                 n,
                 modes.data(),
                 n,
                 radial.vectors.data(),
                 n,
                 rows,
                 n_cells());
        return;
      }
    const int own = transposition->columns.count;
    MPI_Alltoallv(modes.data(),
                  receive_count.data(),
                  receive_offset.data(),
                  MPI_DOUBLE,
                  message.data(),
                  send_count.data(),
                  send_offset.data(),
                  MPI_DOUBLE,
                  grid.communicator());
    const double *from = message.data();
    for_each_share([&](const mpi::Share &other) {
      for (int c = 0; c < own; ++c, from += other.count)
        std::copy_n(
          from,
          other.count,
          &column_modes[static_cast<std::size_t>(c) * n + other.first]);
    });
    multiply('N',
             'N',
             n,
             own,
             n,
             radial.vectors.data(),
             n,
             column_modes.data(),
             n,
             columns.data(),
             n);
    transposition->to_rows(columns.data(), rows, n_cells());
  }

  template <typename Function>
  void
  StretchedEnds::for_each_share(const Function &function) const
  {
    const int n_ranks = mpi::size(grid.communicator());
    for (int q = 0; q < n_ranks; ++q)
      function(mpi::share(radial.n, q, n_ranks));
  }
} // namespace ephyra::fluid
