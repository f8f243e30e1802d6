#pragma once

#include "ephyra/base/mpi.h"

#include <vector>

namespace ephyra::fluid
{
  /// One direction of a tensor grid: cells, their faces and the distances that
  /// finite differences need, m. Index 0 is the first cell; faces 0 ... n.
  struct GridLine
  {
    /// Throws InputError unless the faces increase and there are two cells.
    explicit GridLine(std::vector<double> faces);

    int                 n_cells;
    std::vector<double> face;       ///< n + 1
    std::vector<double> centre;     ///< n
    std::vector<double> width;      ///< n: face[i + 1] - face[i]
    std::vector<double> centre_gap; ///< n + 1: distance of the centres beside
                                    ///< face i; half a cell at the ends
    bool uniform;                   ///< all widths equal to round-off

    double
    length() const
    {
      return face.back() - face.front();
    }
    /// Distance of the values beside face k where a ghost mirrors the cell at
    /// the end of a line that is not periodic: a whole cell there, else
    /// centre_gap.
    double
    mirrored_gap(int k, bool periodic) const;
    /// Smallest width of a cell, m.
    double
    smallest_width() const;
    /// Largest ratio of the widths of two neighbouring cells, >= 1.
    double
    largest_ratio() const;

    /// Cell that holds x; -1 or n_cells outside.
    int
    cell_of(double x) const;
  };

  /// Axisymmetric staggered grid (Harlow & Welch layout; Verzicco & Orlandi
  /// 1996, 10.1006/jcph.1996.0033) over [0, R] x [y0, y1], distributed over the
  /// ranks by rows of constant r. Pressure sits in cells (i, j), the radial
  /// velocity on the faces r = r.face[i], the axial one on y = y.face[j].
  class StaggeredGrid
  {
  public:
    /// In a periodic direction the centre gap of the first and the last face is
    /// the distance across the seam. Throws InputError where the grid does not
    /// start at the axis r = 0 or has fewer than two rows for each rank.
    StaggeredGrid(GridLine r, GridLine y, bool periodic_y, MPI_Comm comm);

    const GridLine r;
    GridLine       y; ///< its positions are changed by shift_y() alone
    const bool     periodic_y;

    /// Moves the grid by so many cells along y (a moving window). Faces follow
    /// from those of the start and the number of cells since then, so no
    /// round-off adds up; widths stay as they are. Stencils by index that were
    /// made for places before have to be made anew. y must be uniform and not
    /// periodic.
    void
    shift_y(int n_cells);
    /// Cells by which the grid has moved since the start.
    int
    shift() const
    {
      return shifted;
    }
    /// The same in m.
    double
    shift_distance() const;

    MPI_Comm
    communicator() const
    {
      return comm;
    }
    /// Rows of cells of this rank: [first_row, first_row + n_rows).
    int first_row;
    int n_rows;
    int
    end_row() const
    {
      return first_row + n_rows;
    }
    bool
    is_first_rank() const
    {
      return first_row == 0;
    }
    bool
    is_last_rank() const
    {
      return end_row() == r.n_cells;
    }
    /// Whether row i of cells is held here.
    bool
    owns_row(int i) const
    {
      return i >= first_row && i < end_row();
    }

  private:
    MPI_Comm            comm;
    std::vector<double> start_faces; ///< of y, before any shift, m
    int                 shifted = 0;
  };
} // namespace ephyra::fluid
