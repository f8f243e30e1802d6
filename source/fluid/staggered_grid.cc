#include "ephyra/fluid/staggered_grid.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>
#include <cmath>

namespace ephyra::fluid
{
  namespace
  {
    GridLine
    close_periodic(GridLine line, const bool periodic)
    {
      if (periodic)
        line.centre_gap.front() = line.centre_gap.back() =
          0.5 * (line.width.front() + line.width.back());
      return line;
    }
  } // namespace

  GridLine::GridLine(std::vector<double> faces)
    : n_cells(static_cast<int>(faces.size()) - 1)
    , face(std::move(faces))
  {
    EphyraThrowIf(
      n_cells < 2,
      InputError,
      "A direction of the flow grid has "
        << std::max(n_cells, 0)
        << " cells, it needs at least 2: choose a smaller spacing.");
    centre.resize(n_cells);
    width.resize(n_cells);
    centre_gap.resize(n_cells + 1);
    for (int i = 0; i < n_cells; ++i)
      {
        EphyraThrowIf(!(face[i + 1] > face[i]),
                      InputError,
                      "The faces of the flow grid must increase, but "
                        << face[i] << " m is followed by " << face[i + 1]
                        << " m: check the breakpoints.");
        width[i]  = face[i + 1] - face[i];
        centre[i] = 0.5 * (face[i] + face[i + 1]);
      }
    centre_gap.front() = 0.5 * width.front();
    centre_gap.back()  = 0.5 * width.back();
    for (int i = 1; i < n_cells; ++i)
      centre_gap[i] = centre[i] - centre[i - 1];

    const double mean = length() / n_cells;
    const double scale =
      std::max(std::abs(face.front()), std::abs(face.back()));
    uniform = true;
    for (const double w : width)
      uniform = uniform && std::abs(w - mean) <= 1e-10 * mean + 4e-16 * scale;
  }

  double
  GridLine::mirrored_gap(const int k, const bool periodic) const
  {
    if (periodic || (k > 0 && k < n_cells))
      return centre_gap[k];
    return k == 0 ? width.front() : width.back();
  }

  double
  GridLine::smallest_width() const
  {
    return *std::min_element(width.begin(), width.end());
  }

  double
  GridLine::largest_ratio() const
  {
    double ratio = 1;
    for (int i = 1; i < n_cells; ++i)
      ratio =
        std::max({ratio, width[i] / width[i - 1], width[i - 1] / width[i]});
    return ratio;
  }

  int
  GridLine::cell_of(const double x) const
  {
    if (!(x >= face.front()))
      return -1;
    if (x >= face.back())
      return n_cells;
    if (uniform)
      {
        // The division may miss by one cell next to a face.
        int i =
          std::min(static_cast<int>((x - face.front()) / length() * n_cells),
                   n_cells - 1);
        if (x < face[i])
          --i;
        else if (x >= face[i + 1])
          ++i;
        return i;
      }
    return static_cast<int>(std::upper_bound(face.begin(), face.end(), x) -
                            face.begin()) -
           1;
  }

  StaggeredGrid::StaggeredGrid(GridLine       r,
                               GridLine       y,
                               const bool     periodic_y,
                               const MPI_Comm comm)
    : r(std::move(r))
    , y(close_periodic(std::move(y), periodic_y))
    , periodic_y(periodic_y)
    , comm(comm)
    , start_faces(this->y.face)
  {
    EphyraThrowIf(this->r.face.front() != 0,
                  InputError,
                  "The flow grid starts at r = "
                    << this->r.face.front()
                    << " m, it has to start at the axis r = 0.");
    const int n_ranks = mpi::size(comm);
    EphyraThrowIf(this->r.n_cells < 2 * n_ranks,
                  InputError,
                  "The flow grid has "
                    << this->r.n_cells << " rows in r for " << n_ranks
                    << " ranks, each needs two: use at most "
                    << this->r.n_cells / 2 << " ranks or a finer grid.");
    const mpi::Share share =
      mpi::share(this->r.n_cells, mpi::rank(comm), n_ranks);
    first_row = share.first;
    n_rows    = share.count;
  }

  double
  StaggeredGrid::shift_distance() const
  {
    return shifted * ((start_faces.back() - start_faces.front()) / y.n_cells);
  }

  void
  StaggeredGrid::shift_y(const int n_cells)
  {
    EphyraAssert(y.uniform && !periodic_y, "only a uniform y can be shifted");
    shifted += n_cells;
    const double distance = shift_distance();
    for (int j = 0; j <= y.n_cells; ++j)
      y.face[j] = start_faces[j] + distance;
    for (int j = 0; j < y.n_cells; ++j)
      y.centre[j] = 0.5 * (y.face[j] + y.face[j + 1]);
  }
} // namespace ephyra::fluid
