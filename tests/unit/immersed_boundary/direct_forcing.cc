#include "ephyra/immersed_boundary/direct_forcing.h"

#include "ephyra/base/mpi.h"

#include <Eigen/Eigenvalues>

#include <boost/test/unit_test.hpp>

#include "grids.h"

using namespace ephyra;
using namespace ephyra::immersed_boundary;

BOOST_AUTO_TEST_SUITE(direct_forcing)

namespace
{
  fluid::StaggeredGrid
  make_grid(const double   stretching = 0.3,
            const MPI_Comm comm       = MPI_COMM_WORLD,
            const int      n_y        = 48)
  {
    return {test::line(24, 0., 1., stretching),
            test::line(n_y, -1., 1., stretching),
            false,
            comm};
  }

  Markers
  sphere(const fluid::StaggeredGrid &grid)
  {
    const Outline o = test::spheroid(0.5, 0.5, "sphere");
    return Markers(o.curves, control_vector(o, 0.021), grid);
  }

  /// Some force with no symmetry.
  std::vector<double>
  some_force(const int n)
  {
    std::vector<double> F(2 * n);
    for (int l = 0; l < 2 * n; ++l)
      F[l] = std::sin(0.3 * l) + 0.4;
    return F;
  }

  double
  some_velocity(const double r, const double y)
  {
    return r * std::cos(3 * y) + r * r;
  }
} // namespace

BOOST_AUTO_TEST_CASE(the_impulse_is_conserved)
{
  // Also across the seam of a periodic grid.
  for (const auto &[shift, periodic] :
       {std::pair{0., false}, {0.4, false}, {0.25, true}})
    {
      const fluid::StaggeredGrid grid(test::line(24, 0., 1., 0.3),
                                      test::line(48, -1., 1., 0.3),
                                      periodic,
                                      MPI_COMM_WORLD);
      const Outline              o = test::spheroid(0.5, 0.5, "sphere");
      const Markers              markers(
        o.curves, control_vector(o, periodic ? 0.9 : 0.021), grid);
      Parameters parameters;
      parameters.inward_shift = shift;
      DirectForcing forcing(grid, parameters);
      forcing.update(markers);
      const int                 n = markers.size();
      const std::vector<double> F = some_force(n);
      fluid::VelocityField      u(grid);
      u.r.fill(0.);
      u.y.fill(0.);
      forcing.spread(F, u);
      double given[2]    = {0, 0};
      double received[2] = {0, 0};
      for (int l = 0; l < n; ++l)
        for (int c = 0; c < 2; ++c)
          given[c] += forcing.impulse_weights()[l] * F[c * n + l];
      for (int i = grid.first_row; i < grid.end_row(); ++i)
        for (int j = 0; j < grid.y.n_cells; ++j)
          {
            received[0] += u.r(i, j) * 2 * M_PI * grid.r.face[i] *
                           grid.r.centre_gap[i] * grid.y.width[j];
            received[1] += u.y(i, j) * 2 * M_PI * grid.r.centre[i] *
                           grid.r.width[i] * grid.y.centre_gap[j];
          }
      for (int c = 0; c < 2; ++c)
        BOOST_TEST(std::abs(mpi::sum(received[c], grid.communicator()) -
                            given[c]) < 1e-12 * std::abs(given[c]));
    }
}

BOOST_AUTO_TEST_CASE(scale_is_the_spacing_in_cells)
{
  // On a uniform grid away from the axis c_l = ds_l eta_l / (Delta_r Delta_y),
  // whatever the aspect ratio: the row sums of S are that, and by construction
  // of eta that is the spacing in cells.
  for (const int n_y : {48, 480})
    {
      const fluid::StaggeredGrid grid = make_grid(0., MPI_COMM_SELF, n_y);
      const Outline              o    = test::torus(0.6, 0.3, "torus");
      const Markers markers(o.curves, control_vector(o, 0.021), grid);
      DirectForcing forcing(grid);
      forcing.update(markers);
      const int            n = markers.size();
      fluid::VelocityField u(grid);
      for (int l = 0; l < n; l += 7)
        {
          std::vector<double> F(2 * n, 0.);
          F[l] = 1.;
          u.r.fill(0.);
          forcing.spread(F, u);
          double sum = 0;
          for (int i = 0; i < grid.end_row(); ++i)
            for (int j = 0; j < grid.y.n_cells; ++j)
              sum += u.r(i, j);
          const MarkerState &m       = markers.state();
          const double       spacing = length_in_cells(grid,
                                                 m.r[l],
                                                 m.y[l],
                                                 m.length[l] * m.t_r[l],
                                                 m.length[l] * m.t_y[l]);
          BOOST_TEST(std::abs(sum - spacing) < 1e-10);
        }
    }
}

BOOST_AUTO_TEST_CASE(scaled_sweeps_leave_nothing_of_an_even_force)
{
  const fluid::StaggeredGrid grid = make_grid(0.3, MPI_COMM_SELF);
  const Outline              o    = test::torus(0.6, 0.3, "torus");
  const Markers              markers(o.curves, control_vector(o, 0.021), grid);
  const int                  n = markers.size();
  for (const ForcingSolver solver :
       {ForcingSolver::sweeps, ForcingSolver::scaled_sweeps})
    {
      Parameters parameters;
      parameters.forcing_solver = solver;
      DirectForcing forcing(grid, parameters);
      forcing.update(markers);
      const Eigen::VectorXd one = Eigen::VectorXd::Ones(n);
      for (int c = 0; c < 2; ++c)
        {
          // The residual of a force of one all along.
          const Eigen::VectorXd residual = forcing.marker_matrix(c) * one;
          std::vector<double>   both(2 * n, 0.), F;
          std::copy(residual.data(), residual.data() + n, both.begin() + c * n);
          forcing.solve(both, F);
          double left = 0;
          for (int l = 0; l < n; ++l)
            left = std::max(left, std::abs(F[c * n + l] - 1.));
          if (solver == ForcingSolver::sweeps)
            BOOST_TEST(left > 0.02);
          else
            BOOST_TEST(left < 1e-12);
          const Eigen::VectorXd same = forcing.transfer(c) * residual;
          for (int l = 0; l < n; ++l)
            BOOST_TEST(std::abs(same[l] - F[c * n + l]) < 1e-12);
          // What is left of any other force does not grow.
          Eigen::MatrixXd DM = forcing.marker_matrix(c);
          for (int l = 0; l < n; ++l)
            DM.row(l) /= residual[l];
          for (const auto &lambda : DM.eigenvalues())
            BOOST_TEST(std::abs(1. - lambda) < 1. + 1e-9);
        }
    }
}

BOOST_AUTO_TEST_CASE(spectrum_lies_between_zero_and_one)
{
  for (const int n_y : {48, 480})
    {
      const fluid::StaggeredGrid grid    = make_grid(0.3, MPI_COMM_SELF, n_y);
      const Markers              markers = sphere(grid);
      DirectForcing              forcing(grid);
      forcing.update(markers);
      for (int c = 0; c < 2; ++c)
        {
          const Eigen::MatrixXd  M = forcing.marker_matrix(c);
          const Eigen::VectorXcd eigenvalues =
            Eigen::EigenSolver<Eigen::MatrixXd>(M, false).eigenvalues();
          BOOST_TEST(eigenvalues.imag().cwiseAbs().maxCoeff() < 1e-8);
          BOOST_TEST(eigenvalues.real().minCoeff() > -1e-10);
          BOOST_TEST(eigenvalues.real().maxCoeff() < 1.);
          BOOST_TEST_MESSAGE("component " << c << ", " << n_y
                                          << " columns: largest eigenvalue "
                                          << eigenvalues.real().maxCoeff());
        }
    }
}

BOOST_AUTO_TEST_CASE(the_matrix_and_the_transfer_do_what_the_fields_do)
{
  const fluid::StaggeredGrid grid    = make_grid();
  const Markers              markers = sphere(grid);
  for (const ForcingSolver solver :
       {ForcingSolver::sweeps, ForcingSolver::scaled_sweeps})
    {
      Parameters parameters;
      parameters.forcing_solver = solver;
      DirectForcing forcing(grid, parameters);
      forcing.update(markers);
      const int n = markers.size();

      fluid::VelocityField u(grid);
      test::fill(u, some_velocity, some_velocity);
      std::vector<double> Ju, F(2 * n, 0.), residual(2 * n), Ju0;
      forcing.interpolate(u, Ju0);
      for (int l = 0; l < 2 * n; ++l)
        residual[l] = 0.7 - Ju0[l];
      std::vector<double> by_matrix;
      forcing.solve(residual, by_matrix);

      // Three sweeps over the field itself.
      std::vector<double> relaxation(2 * n, 1.);
      if (solver == ForcingSolver::scaled_sweeps)
        for (int c = 0; c < 2; ++c)
          for (int l = 0; l < n; ++l)
            relaxation[c * n + l] = 1. / forcing.marker_matrix(c).row(l).sum();
      for (int sweep = 0; sweep < 3; ++sweep)
        {
          forcing.interpolate(u, Ju);
          std::vector<double> increment(2 * n);
          for (int l = 0; l < 2 * n; ++l)
            F[l] += increment[l] = relaxation[l] * (0.7 - Ju[l]);
          forcing.spread(increment, u);
        }
      double error = 0;
      for (int l = 0; l < 2 * n; ++l)
        error = std::max(error, std::abs(F[l] - by_matrix[l]));
      BOOST_TEST(error < 1e-12);

      for (int c = 0; c < 2; ++c)
        {
          const Eigen::Map<const Eigen::VectorXd> r(residual.data() + c * n, n),
            f(by_matrix.data() + c * n, n);
          BOOST_TEST((forcing.transfer(c) * r - f).cwiseAbs().maxCoeff() <
                     1e-12);
        }
    }
}

BOOST_AUTO_TEST_CASE(exact_forcing_meets_the_markers)
{
  const fluid::StaggeredGrid grid    = make_grid();
  const Markers              markers = sphere(grid);
  Parameters                 parameters;
  parameters.forcing_solver = ForcingSolver::exact;
  DirectForcing forcing(grid, parameters);
  forcing.update(markers);
  const int            n = markers.size();
  fluid::VelocityField u(grid);
  test::fill(u, some_velocity, some_velocity);
  std::vector<double> Ju, residual(2 * n), F;
  forcing.interpolate(u, Ju);
  const MarkerState &m = markers.state();
  for (int l = 0; l < n; ++l) // a smooth velocity: 2 r along r, 0.7 along y
    {
      residual[l]     = 2 * m.r[l] - Ju[l];
      residual[n + l] = 0.7 - Ju[n + l];
    }
  forcing.solve(residual, F);
  forcing.spread(F, u);
  forcing.interpolate(u, Ju);
  double slip = 0;
  for (int l = 0; l < n; ++l)
    slip =
      std::max({slip, std::abs(2 * m.r[l] - Ju[l]), std::abs(0.7 - Ju[n + l])});
  BOOST_TEST_MESSAGE("largest slip " << slip);
  BOOST_TEST(slip < 1e-4);
  const Eigen::Map<const Eigen::VectorXd> r(residual.data() + n, n),
    f(F.data() + n, n);
  BOOST_TEST((forcing.transfer(1) * r - f).norm() < 1e-8 * f.norm());
}

BOOST_AUTO_TEST_CASE(any_number_of_ranks_gives_the_same)
{
  std::vector<double> F[2], Ju[2];
  for (int k = 0; k < 2; ++k)
    {
      const fluid::StaggeredGrid grid =
        make_grid(0.3, k == 0 ? MPI_COMM_SELF : MPI_COMM_WORLD);
      const Markers markers = sphere(grid);
      DirectForcing forcing(grid);
      forcing.update(markers);
      fluid::VelocityField u(grid);
      test::fill(u, some_velocity, some_velocity);
      forcing.interpolate(u, Ju[k]);
      forcing.solve(Ju[k], F[k]);
      forcing.spread(F[k], u);
      forcing.interpolate(u, Ju[k]);
    }
  double error = 0;
  for (std::size_t l = 0; l < F[0].size(); ++l)
    error = std::max(
      {error, std::abs(F[0][l] - F[1][l]), std::abs(Ju[0][l] - Ju[1][l])});
  BOOST_TEST(error < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
