#include "ephyra/immersed_boundary/interior_momentum.h"

#include "ephyra/base/mpi.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ephyra::immersed_boundary
{
  double
  interior_axial_momentum(const Markers                 &markers,
                          const int                      first_curve,
                          const int                      last_curve,
                          const fluid::DistributedArray &v_y,
                          const double                   y_reference)
  {
    const fluid::StaggeredGrid &grid  = v_y.grid();
    const MarkerState          &m     = markers.state();
    const int                   begin = markers.first_of_curve()[first_curve];
    const int                   end   = markers.first_of_curve()[last_curve];
    const fluid::GridLine      &y     = grid.y;

    // Columns of cells that G needs.
    double low = y_reference, high = y_reference, r_max = 0;
    for (int l = begin; l < end; ++l)
      {
        low   = std::min(low, m.y[l]);
        high  = std::max(high, m.y[l]);
        r_max = std::max(r_max, m.r[l]);
      }
    const double length = y.face.back() - y.face.front();
    const auto   cell   = [&](const double at) { // continued periodically
      if (!grid.periodic_y)
        return std::clamp(y.cell_of(at), 0, y.n_cells - 1);
      const double turns = std::floor((at - y.face.front()) / length);
      return std::clamp(y.cell_of(at - turns * length), 0, y.n_cells - 1) +
             static_cast<int>(turns) * y.n_cells;
    };
    const int  j_low = cell(low), n = cell(high) - j_low + 1;
    const auto wrap = [&](const int j) {
      return ((j % y.n_cells) + y.n_cells) % y.n_cells;
    };
    const auto lower_face = [&](const int j) {
      return y.face[wrap(j)] + length * ((j - wrap(j)) / y.n_cells);
    };

    const int i_begin = grid.first_row;
    const int i_end =
      std::min(grid.end_row(), std::max(0, grid.r.cell_of(r_max)) + 2);
    if (i_end <= i_begin)
      return mpi::sum(0., grid.communicator());

    // G at the lower faces of the columns, from the lowest one, row by row; v_y
    // is linear in a cell.
    std::vector<double> G(static_cast<std::size_t>(i_end - i_begin) * (n + 1));
    for (int i = i_begin; i < i_end; ++i)
      {
        const double *v = v_y.row(i);
        double       *row =
          G.data() + static_cast<std::size_t>(i - i_begin) * (n + 1);
        row[0] = 0;
        for (int j = 0; j < n; ++j)
          {
            const int    w     = wrap(j_low + j);
            const double upper = grid.periodic_y ? v[wrap(w + 1)] : v[w + 1];
            row[j + 1]         = row[j] + 0.5 * y.width[w] * (v[w] + upper);
          }
      }
    const auto integral = [&](const int i, const double at) {
      const int     j  = cell(at) - j_low;
      const int     w  = wrap(j_low + j);
      const double *v  = v_y.row(i);
      const double  v1 = grid.periodic_y ? v[wrap(w + 1)] : v[w + 1];
      const double  s  = at - lower_face(j_low + j);
      const double *row =
        G.data() + static_cast<std::size_t>(i - i_begin) * (n + 1);
      return row[j] + s * (v[w] + 0.5 * s / y.width[w] * (v1 - v[w]));
    };

    double sum = 0;
    for (int l = begin; l < end; ++l)
      {
        // Linear in r between centres, constant within half a cell of the axis.
        const fluid::GridLine &r = grid.r;
        int i = std::clamp(r.cell_of(m.r[l]), 0, r.n_cells - 1);
        if (m.r[l] < r.centre[i])
          --i;
        const double s =
          i < 0 ? 1.
          : i + 1 == r.n_cells
            ? 0.
            : (m.r[l] - r.centre[i]) / (r.centre[i + 1] - r.centre[i]);
        const double flux = m.n_y[l] * 2 * M_PI * m.r[l] * m.length[l];
        for (int a = 0; a < 2; ++a)
          if (const int row = i + a; row >= i_begin && row < i_end)
            sum += flux * (a == 0 ? 1 - s : s) *
                   (integral(row, m.y[l]) - integral(row, y_reference));
      }
    return mpi::sum(sum, grid.communicator());
  }
} // namespace ephyra::immersed_boundary
