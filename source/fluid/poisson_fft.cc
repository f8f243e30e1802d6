#include "ephyra/fluid/poisson_fft.h"

#include "ephyra/base/exceptions.h"

#include <fftw3.h>

#include <cmath>

namespace ephyra::fluid
{
  namespace
  {
    /// Transform pair and squared wave numbers that fit the sides in y.
    struct Kind
    {
      fftw_r2r_kind forward, backward;
      double        shift; ///< mode k has the phase pi (k + shift) / n
    };

    Kind
    kind_of(const PoissonSides &sides)
    {
      if (sides.lower_dirichlet)
        return sides.upper_dirichlet ? Kind{FFTW_RODFT10, FFTW_RODFT01, 1.}
                                     : Kind{FFTW_RODFT11, FFTW_RODFT11, 0.5};
      return sides.upper_dirichlet ? Kind{FFTW_REDFT11, FFTW_REDFT11, 0.5}
                                   : Kind{FFTW_REDFT10, FFTW_REDFT01, 0.};
    }

    /// Eigenvalues of -d2/dy2 on the grid, 1/m^2.
    std::vector<double>
    eigenvalues(const StaggeredGrid &grid, const PoissonSides &sides)
    {
      const int           n = grid.y.n_cells;
      const double        h = grid.y.length() / n;
      std::vector<double> lambda(n);
      for (int k = 0; k < n; ++k)
        {
          const double phase = grid.periodic_y
                                 ? M_PI * std::min(k, n - k) / n
                                 : 0.5 * M_PI * (k + kind_of(sides).shift) / n;
          lambda[k]          = std::pow(2. / h * std::sin(phase), 2);
        }
      return lambda;
    }
  } // namespace

  RowTridiagonal::Rows
  radial_poisson_rows(const StaggeredGrid &grid, const bool outer_dirichlet)
  {
    RowTridiagonal::Rows rows;
    rows.first = grid.first_row;
    for (int i = grid.first_row; i < grid.end_row(); ++i)
      {
        const bool   outermost = i == grid.r.n_cells - 1;
        const double lower     = grid.r.face[i] / grid.r.centre_gap[i];
        const double upper     = outermost && !outer_dirichlet
                                   ? 0.
                                   : grid.r.face[i + 1] / grid.r.centre_gap[i + 1];
        rows.lower.push_back(lower);
        rows.upper.push_back(upper);
        rows.diagonal.push_back(-(lower + upper));
        rows.weight.push_back(grid.r.centre[i] * grid.r.width[i]);
      }
    return rows;
  }

  struct PoissonFft::Transforms
  {
    Transforms(const StaggeredGrid &grid, const PoissonSides &sides)
    {
      const int     n = grid.y.n_cells;
      AlignedVector row(n);
      modes[0].resize(n);
      modes[1].resize(n);
      const Kind kind = kind_of(sides);
      forward         = fftw_plan_r2r_1d(n,
                                 row.data(),
                                 row.data(),
                                 grid.periodic_y ? FFTW_R2HC : kind.forward,
                                 FFTW_MEASURE);
      backward        = fftw_plan_r2r_1d(n,
                                  modes[0].data(),
                                  row.data(),
                                  grid.periodic_y ? FFTW_HC2R : kind.backward,
                                  FFTW_MEASURE | FFTW_PRESERVE_INPUT);
      normalisation   = 1. / (grid.periodic_y ? n : 2 * n);
    }
    ~Transforms()
    {
      fftw_destroy_plan(forward);
      fftw_destroy_plan(backward);
    }
    fftw_plan     forward, backward;
    double        normalisation;
    AlignedVector modes[2];
  };

  PoissonFft::PoissonFft(const StaggeredGrid &grid, const PoissonSides &sides)
    : grid(grid)
    , transforms(std::make_unique<Transforms>(grid, sides))
    , tridiagonal(radial_poisson_rows(grid, sides.outer_dirichlet),
                  eigenvalues(grid, sides),
                  grid.y.n_cells,
                  sides.singular(),
                  grid.communicator())
  {
    EphyraThrowIf(!grid.y.uniform,
                  InputError,
                  "The Poisson solver \"fft\" needs a uniform axial spacing: "
                  "choose \"auto\" or \"eigen\", or one axial spacing.");
  }

  PoissonFft::~PoissonFft() = default;

  void
  PoissonFft::solve(DistributedArray  &phi,
                    const RowFunction &right_hand_side,
                    const RowFunction &visit)
  {
    const int n_y = grid.y.n_cells;
    for (int s = 0; s < tridiagonal.n_steps(); ++s)
      {
        const int     i   = tridiagonal.row(s);
        double *const row = phi.row(i);
        right_hand_side(i, row);
        const double scale =
          grid.r.centre[i] * grid.r.width[i] * transforms->normalisation;
        for (int j = 0; j < n_y; ++j)
          row[j] *= scale;
        fftw_execute_r2r(transforms->forward, row, row);
        tridiagonal.eliminate(s, row);
      }
    tridiagonal.solve_interfaces();
    // The modes of a row are needed once more by the next one, so they live in
    // two rows taken in turn.
    for (int s = tridiagonal.n_steps() - 1; s >= 0; --s)
      {
        const int     i     = tridiagonal.row(s);
        double *const row   = phi.row(i);
        double *const modes = transforms->modes[s % 2].data();
        tridiagonal.substitute(s, row, modes);
        fftw_execute_r2r(transforms->backward, modes, row);
        visit(i, row);
      }
  }
} // namespace ephyra::fluid
