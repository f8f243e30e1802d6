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

  /// Largest difference of the outer profile to the reference beyond
  /// z = 0.25 m; the corner at z = 0 is singular.
  double
  profile_error(const bool                follower,
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
    double    error  = 0.;
    const int column = follower ? 1 : 7;
    for (const auto &row : reference())
      if (row[0] > 0.25)
        {
          const auto u = solver.fields(row[0] / 1.5, 1.).displacement;
          error        = std::max({error,
                                   std::abs(u.r - row[column]),
                                   std::abs(u.y - row[column + 1])});
        }
    const auto tip = solver.fields(1., 1.).displacement;
    BOOST_TEST_MESSAGE((follower ? "follower" : "dead")
                       << ", degree " << degree << ", " << n[0] << " x " << n[1]
                       << ": largest difference " << error << " m, free end "
                       << tip.r << ", " << tip.y << ", steps " << result.steps
                       << ", iterations " << result.iterations);
    return error;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(cantilever_tube)

// The paper's 200 cubic elements. The clamped outer corner is singular, so that
// the error on uniform meshes falls with h only, whatever the degree; CalculiX
// on its finest mesh is 2.2e-4 m away at the free end.
BOOST_AUTO_TEST_CASE(outer_profile)
{
  BOOST_TEST(reference().size() == 61u);
  BOOST_TEST(profile_error(true, 3, {{40, 5}}) < 7e-4);
  BOOST_TEST(profile_error(false, 3, {{40, 5}}) < 6e-4);
}

BOOST_AUTO_TEST_CASE(long_outer_profile_refined)
{
  for (const bool follower : {true, false})
    {
      const double coarse = profile_error(follower, 3, {{40, 5}});
      const double middle = profile_error(follower, 3, {{80, 10}});
      const double fine   = profile_error(follower, 4, {{120, 15}});
      BOOST_TEST(middle < 0.65 * coarse);
      BOOST_TEST(fine < 0.65 * middle);
    }
}

BOOST_AUTO_TEST_SUITE_END()
