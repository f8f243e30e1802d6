// Quasi-static contraction of the bell in vacuum.
#include "ephyra/geometry/bell.h"
#include "ephyra/elasticity/statics.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  struct Drop
  {
    double                inner, outer; ///< relative reduction of the radius
    StaticsSolver::Result result;
    double                volume; ///< relative change
  };

  /// Margin of the contracted bell, gamma = 1 throughout.
  Drop
  contract(const ActiveStrain::Form form,
           const double             a3,
           const int                n1,
           const int                n2)
  {
    StaticsSolver::Parameters prm;
    prm.body.active_strain.form = form;
    prm.body.active_strain.a3   = a3;
    prm.body.sides[0].fixed     = {{true, true}};
    prm.n_steps                 = 5;
    geometry::Discretization mesh;
    mesh.n_elements  = {{n1, n2}};
    const auto patch = geometry::make_bell({}, 0., mesh).patch;

    StaticsSolver solver(prm, patch, MPI_COMM_WORLD);
    const double  volume = solver.measures().volume;
    Drop          drop;
    drop.result = solver.run([](double, std::vector<double> &gamma) {
      gamma.assign(gamma.size(), 1.);
    });
    BOOST_TEST(drop.result.success, drop.result.reason);
    const auto relative = [&](const double theta2) {
      return -solver.fields(1., theta2).displacement.r /
             patch.point({1., theta2}).r;
    };
    drop.inner  = relative(0.);
    drop.outer  = relative(1.);
    drop.volume = solver.measures().volume / volume - 1.;
    BOOST_TEST_MESSAGE(
      (form == ActiveStrain::Form::paper_metric ? "paper metric"
                                                : "unit directors")
      << ", a3 = " << a3 << ", " << n1 << " x " << n2 << ": margin "
      << 100. * drop.inner << " % inner, " << 100. * drop.outer
      << " % outer, volume " << 100. * drop.volume << " %, "
      << drop.result.steps << " steps, " << drop.result.cut_backs << " cuts, "
      << drop.result.iterations << " iterations, unknowns "
      << solver.displacement().size());
    return drop;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(bell)

// An independent prototype (cubic, 20 x 6 elements, the joint of ellipse and
// flap elsewhere in theta^1 and another map across the thickness, both of which
// the paper leaves open) gave 4.4 and 4.1 %, 22 and 20 %.
BOOST_AUTO_TEST_CASE(contraction)
{
  const auto close = boost::test_tools::tolerance(.12);
  const auto weak  = contract(ActiveStrain::Form::unit_directors, 0.096, 20, 6);
  BOOST_TEST(weak.inner == .044, close);
  BOOST_TEST(weak.outer == .041, close);
  const auto paper = contract(ActiveStrain::Form::paper_metric, 0.096, 20, 6);
  BOOST_TEST(paper.inner == .22, close);
  BOOST_TEST(paper.outer == .20, close);
  BOOST_TEST(std::abs(paper.volume) < 1e-4);
}

BOOST_AUTO_TEST_CASE(long_contraction)
{
  for (const double a3 : {.3, .5, .6, .7})
    contract(ActiveStrain::Form::unit_directors, a3, 20, 6);
  for (const double a3 : {.12, .134, .144})
    contract(ActiveStrain::Form::paper_metric, a3, 20, 6);
  // Converged along the bell, and across the thin layer of muscle.
  const auto along = [](const int n) {
    return contract(ActiveStrain::Form::paper_metric, .134, n, 6).inner;
  };
  const auto across = [](const int n) {
    return contract(ActiveStrain::Form::paper_metric, .134, 20, n).inner;
  };
  const double fine = along(40);
  BOOST_TEST(along(80) == fine, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(across(24) == across(12), boost::test_tools::tolerance(2e-3));
}

BOOST_AUTO_TEST_SUITE_END()
