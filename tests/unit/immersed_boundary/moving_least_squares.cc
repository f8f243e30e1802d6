#include "ephyra/immersed_boundary/moving_least_squares.h"

#include <boost/test/unit_test.hpp>

#include "grids.h"

using namespace ephyra;
using namespace ephyra::immersed_boundary;

BOOST_AUTO_TEST_SUITE(moving_least_squares)

namespace
{
  fluid::StaggeredGrid
  make_grid(const int n, const bool periodic = false)
  {
    return {test::line(n, 0., 1., 0.4),
            test::line(2 * n, -1., 1., 0.3),
            periodic,
            MPI_COMM_SELF};
  }

  double
  apply(const Stencil &s, const fluid::DistributedArray &u)
  {
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        sum += s.value[a][b] * u(s.row[a], s.column[b]);
    return sum;
  }

  /// Points everywhere: at the axis, at the walls, on nodes and between.
  template <class Check>
  void
  at_points(const Check &check)
  {
    for (int a = 0; a <= 50; ++a)
      for (int b = 0; b <= 50; ++b)
        check(a / 50., -1. + b / 25.);
  }
} // namespace

BOOST_AUTO_TEST_CASE(linear_fields_and_their_gradients_are_exact)
{
  const fluid::StaggeredGrid grid = make_grid(16);
  fluid::VelocityField       u(grid);
  fluid::DistributedArray    p(grid);
  // v_r is odd in r and v_y, p even: linear in r only where no ghost row of the
  // axis takes part.
  const auto linear = [](const double r, const double y) {
    return 3. - 2. * r + 0.7 * y;
  };
  test::fill(u, linear, linear);
  test::fill_cells(p, linear);
  for (const WeightFunction weight :
       {WeightFunction::exponential, WeightFunction::cubic_spline})
    {
      Parameters parameters;
      parameters.weight = weight;
      const MovingLeastSquares mls(grid, parameters);
      double                   error = 0, gradient_error = 0;
      at_points([&](const double r, const double y) {
        if (r < 2 * grid.r.width[0])
          return;
        const auto rf = mls.r_faces(r), rc = mls.r_centres(r);
        const auto yf = mls.y_faces(y), yc = mls.y_centres(y);
        const auto add = [&](const auto                    &r_line,
                             const auto                    &y_line,
                             const fluid::DistributedArray &v) {
          error = std::max(
            error,
            std::abs(apply(mls.value(r_line, y_line), v) - linear(r, y)));
          gradient_error = std::max(
            {gradient_error,
             std::abs(apply(mls.derivative_r(r_line, y_line), v) + 2.),
             std::abs(apply(mls.derivative_y(r_line, y_line), v) - 0.7)});
        };
        add(rf, yc, u.r);
        add(rc, yf, u.y);
        add(rc, yc, p);
      });
      BOOST_TEST(error < 1e-12);
      BOOST_TEST(gradient_error < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(at_the_axis_odd_and_even_linear_fields_are_exact)
{
  const fluid::StaggeredGrid grid = make_grid(16);
  const MovingLeastSquares   mls(grid, Parameters());
  fluid::VelocityField       u(grid);
  test::fill(
    u,
    [](const double r, double) { return -2. * r; },
    [](double, const double y) { return 1. + 0.7 * y; });
  double error = 0;
  at_points([&](const double r, const double y) {
    const auto rf = mls.r_faces(r), rc = mls.r_centres(r);
    const auto yf = mls.y_faces(y), yc = mls.y_centres(y);
    error = std::max({error,
                      std::abs(apply(mls.value(rf, yc), u.r) + 2. * r),
                      std::abs(apply(mls.derivative_r(rf, yc), u.r) + 2.),
                      std::abs(apply(mls.value(rc, yf), u.y) - 1. - 0.7 * y),
                      std::abs(apply(mls.derivative_r(rc, yf), u.y))});
  });
  BOOST_TEST(error < 1e-11);
}

BOOST_AUTO_TEST_CASE(a_periodic_grid_has_no_seam)
{
  const fluid::StaggeredGrid grid{
    test::line(8, 0., 1.), test::line(16, -1., 1.), true, MPI_COMM_SELF};
  const MovingLeastSquares mls(grid, Parameters());
  fluid::VelocityField     u(grid);
  const auto sine = [](double, const double y) { return std::sin(M_PI * y); };
  test::fill(u, sine, sine);
  // Moving by whole cells changes nothing, across the seam too.
  for (const double y : {0.01, 0.06, 0.11, 0.124})
    for (int shift = -20; shift < 20; ++shift)
      {
        const double at   = y + shift * 0.125;
        const auto   r    = mls.r_centres(0.4);
        const auto   near = mls.value(r, mls.y_faces(y));
        const auto   far  = mls.value(r, mls.y_faces(at));
        for (int b = 0; b < 3; ++b)
          {
            BOOST_TEST(far.column[b] ==
                       ((near.column[b] + shift) % 16 + 16) % 16);
            BOOST_TEST(std::abs(far.value[1][b] - near.value[1][b]) < 1e-12);
          }
      }
}

BOOST_AUTO_TEST_CASE(orders_of_value_and_gradient)
{
  const auto field = [](const double r, const double y) {
    return std::cos(2 * r * r) * std::sin(3 * y);
  };
  const auto field_y = [](const double r, const double y) {
    return 3 * std::cos(2 * r * r) * std::cos(3 * y);
  };
  std::array<double, 2> value{}, gradient{};
  for (int level = 0; level < 2; ++level)
    {
      const fluid::StaggeredGrid grid = make_grid(level == 0 ? 32 : 64);
      const MovingLeastSquares   mls(grid, Parameters());
      fluid::DistributedArray    p(grid);
      test::fill_cells(p, field);
      int n = 0;
      at_points([&](const double r, const double y) {
        if (std::abs(y) > 0.9 || r > 0.9)
          return;
        const auto rc = mls.r_centres(r), yc = mls.y_centres(y);
        value[level] += std::pow(apply(mls.value(rc, yc), p) - field(r, y), 2);
        gradient[level] +=
          std::pow(apply(mls.derivative_y(rc, yc), p) - field_y(r, y), 2);
        ++n;
      });
      value[level]    = std::sqrt(value[level] / n);
      gradient[level] = std::sqrt(gradient[level] / n);
    }
  const double order_of_value    = std::log2(value[0] / value[1]);
  const double order_of_gradient = std::log2(gradient[0] / gradient[1]);
  BOOST_TEST_MESSAGE("orders: value " << order_of_value << ", gradient "
                                      << order_of_gradient << " (rms error "
                                      << gradient[1] << " of 3)");
  BOOST_TEST(order_of_value > 1.85);
  BOOST_TEST(order_of_gradient > 0.85);
  BOOST_TEST(gradient[1] < 0.03);
}

BOOST_AUTO_TEST_SUITE_END()
