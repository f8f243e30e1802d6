#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/fluid/aligned_vector.h"
#include "ephyra/fluid/staggered_grid.h"

#include <cstddef>
#include <vector>

namespace ephyra::fluid
{
  /// A field on the grid: rows i of constant r, contiguous along y, with
  /// `halo` ghost rows and columns on every side. Rows are global indices:
  /// a(i, j) is valid for i in [first_row - halo, end_row + halo) and j in
  /// [-halo, n_y + halo]. Radial velocity: a(i, j) is the value on the lower
  /// face r.face[i] of cell (i, j); axial velocity: on the lower face
  /// y.face[j]; the face r.face[n_r] is row n_r, held as a ghost row by the
  /// last rank, the face y.face[n_y] is column n_y. Rows start on 64-byte
  /// boundaries.
  class DistributedArray
  {
  public:
    static constexpr int halo = 2;

    explicit DistributedArray(const StaggeredGrid &grid);

    double &
    operator()(const int i, const int j)
    {
      return data[static_cast<std::size_t>(i - first_stored) * stride + offset +
                  j];
    }
    double
    operator()(const int i, const int j) const
    {
      return data[static_cast<std::size_t>(i - first_stored) * stride + offset +
                  j];
    }
    /// Pointer p with p[j] = a(i, j).
    double *
    row(const int i)
    {
      return data.data() + static_cast<std::size_t>(i - first_stored) * stride +
             offset;
    }
    const double *
    row(const int i) const
    {
      return data.data() + static_cast<std::size_t>(i - first_stored) * stride +
             offset;
    }

    /// Distance of two rows in memory, in values.
    int
    row_stride() const
    {
      return static_cast<int>(stride);
    }

    void
    fill(double value);
    /// Copies all values, ghosts included.
    void
    copy_from(const DistributedArray &other);

    /// Copies owned rows into the halo rows of the neighbouring ranks; the
    /// ghosts at the ends of the domain are left alone. Collective.
    void
    exchange_halo();
    /// The same for several arrays of one grid in one message each way.
    static void
    exchange_halos(const std::vector<DistributedArray *> &arrays);
    /// Adds what was put into halo rows to the rows of their owners and zeroes
    /// the halo rows (the transpose of exchange_halo()). Collective.
    void
    add_halo_to_owner();

    /// Owned rows 0 ... n_columns - 1, for archives; with row n_r where
    /// @p with_last_face (the radial velocity).
    RowLayout
    layout(int n_columns, bool with_last_face = false) const;

    const StaggeredGrid &
    grid() const
    {
      return *the_grid;
    }

  private:
    const StaggeredGrid *the_grid;
    int                  first_stored;
    std::size_t          stride;
    std::size_t          offset;
    AlignedVector        data;
  };
} // namespace ephyra::fluid
