// Cantilever tube of appendix A.2 of Nitti et al. 2023
// (10.1016/j.apm.2023.08.003), Fig. A.16, against an independent mixed solution.
#include "elasticity_patches.h"

#include "ephyra/elasticity/statics.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <fstream>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  /// Rows of numbers of the reference.
  std::vector<std::vector<double>>
  reference()
  {
    std::ifstream                    file(EPHYRA_SOURCE_DIR
                       "/tests/verification/reference/elasticity/"
                                          "cantilever_tube.csv");
    std::vector<std::vector<double>> rows;
    std::string                      line;
    while (std::getline(file, line))
      {
        if (line.empty() || line[0] == '#' || line[0] == 'z')
          continue;
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream  text(line);
        std::vector<double> row;
        for (double x; text >> x;)
          row.push_back(x);
        rows.push_back(row);
      }
    return rows;
  }

  /// Differences to the reference, m: the largest on the outer and the inner
  /// surface beyond z = 0.25 m (the corner at z = 0 is singular), and those at
  /// the free end outside.
  struct Errors
  {
    double outer = 0., inner = 0., end_r = 0., end_y = 0.;
  };

  Errors
  profile_errors(const bool                follower,
                 const int                 degree,
                 const std::array<int, 2> &n)
  {
    StaticsSolver::Parameters prm;
    prm.body.material          = {.5e6, 1000e6, false};
    prm.body.sides[0].fixed    = {{true, true}};
    prm.body.sides[2].pressure = Expression("0.2e6", SideCondition::variables);
    prm.body.sides[2].follower = follower;
    prm.n_steps                = 4;
    const auto    patch        = test::tube(.5, .8, 1.5, degree, n);
    StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
    const auto    result = solver.run();
    BOOST_TEST(result.success, result.reason);
    Errors    errors;
    const int column = follower ? 1 : 7;
    for (const auto &row : reference())
      for (int inside = 0; inside < 2; ++inside)
        {
          const auto u = solver.fields(row[0] / 1.5, 1. - inside).displacement;
          const double d_r   = std::abs(u.r - row[column + 2 * inside]);
          const double d_y   = std::abs(u.y - row[column + 2 * inside + 1]);
          double      &worst = inside ? errors.inner : errors.outer;
          if (row[0] > 0.25)
            worst = std::max({worst, d_r, d_y});
          if (row[0] == 1.5 && !inside)
            {
              errors.end_r = d_r;
              errors.end_y = d_y;
            }
        }
    BOOST_TEST_MESSAGE((follower ? "follower" : "dead")
                       << ", degree " << degree << ", " << n[0] << " x " << n[1]
                       << ": outer " << errors.outer << ", inner "
                       << errors.inner << ", free end u_r " << errors.end_r
                       << ", u_z " << errors.end_y << " m; unknowns "
                       << solver.body().n_unknowns() << ", steps "
                       << result.steps << ", iterations " << result.iterations);
    return errors;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(cantilever_tube)

// The paper's 200 cubic elements. The clamped outer corner is singular, so that
// the error on uniform meshes falls with h only, whatever the degree.
BOOST_AUTO_TEST_CASE(profiles)
{
  BOOST_TEST(reference().size() == 61u);
  const auto follower = profile_errors(true, 3, {{40, 5}});
  BOOST_TEST(follower.outer < 7e-4);
  BOOST_TEST(follower.inner < 9e-4);
  const auto dead = profile_errors(false, 3, {{40, 5}});
  BOOST_TEST(dead.outer < 6e-4);
  BOOST_TEST(dead.inner < 7e-4);
}

BOOST_AUTO_TEST_CASE(long_profiles_refined)
{
  for (const bool follower : {true, false})
    for (const int degree : {2, 3, 4, 5})
      {
        Errors before = profile_errors(follower, degree, {{40, 5}});
        for (int k = 2; k <= (degree < 5 ? 3 : 2); ++k)
          {
            const Errors errors =
              profile_errors(follower, degree, {{40 * k, 5 * k}});
            // order 0.55 or more; the corner has the exponent 0.595
            const double factor = std::pow((k - 1.) / k, 0.55);
            BOOST_TEST(errors.outer < factor * before.outer);
            BOOST_TEST(errors.inner < factor * before.inner);
            before = errors;
          }
        if (follower && degree == 4)
          {
            // CalculiX on its finest mesh: u_r .098721, u_z -.070435 m.
            BOOST_TEST(before.end_r < 2e-5);
            BOOST_TEST(before.end_y < 2.2e-4);
          }
      }
}

BOOST_AUTO_TEST_SUITE_END()
