// Manufactured solutions at finite strain, passive and active, with elements at
// the axis: a displacement is chosen, and the body force is -Div P by the strong
// form, written out here and differentiated by finite differences.
#include "elasticity_patches.h"
#include "field_errors.h"

#include "ephyra/elasticity/elasticity_operator.h"
#include "ephyra/elasticity/newton.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::elasticity;

namespace
{
  using Tensor = AxisymmetricTensor;
  using splines::Point;

  constexpr double size = 0.2;
  const double     c10 = 400., K = 5000.;

  const char *const radial_formula = "0.2*r*(cos(2*y) - 0.5*r*r)";
  const char *const axial_formula  = "0.2*(0.5*sin(3*y) + r*r*y)";

  /// The same, with its gradient.
  test::FieldValue
  exact(const Point &x)
  {
    const double h = size * (std::cos(2. * x.y) - 0.5 * x.r * x.r);
    return {{h * x.r, size * (0.5 * std::sin(3. * x.y) + x.r * x.r * x.y)},
            {{h - size * x.r * x.r,
              -2. * size * x.r * std::sin(2. * x.y),
              2. * size * x.r * x.y,
              size * (1.5 * std::cos(3. * x.y) + x.r * x.r),
              h}}};
  }

  struct Case
  {
    std::string                                         name;
    std::function<splines::NurbsPatch<2>(int p, int n)> patch;
    ActiveStrain::Parameters                            active;
    /// F_a at gamma = 1, known in closed form; symmetric.
    std::function<Tensor(const Point &)> F_a;
    std::vector<splines::Side>           fixed;
  };

  /// First Piola-Kirchhoff stress of F = F_e F_a for the energy (10).
  Tensor
  stress(const Case &c, const Point &x)
  {
    Tensor F = exact(x).gradient;
    for (const int i : {0, 3, 4})
      F[i] += 1.;
    const Tensor A   = c.F_a(x);
    const double det = A[0] * A[3] - A[1] * A[1];
    const Tensor G{A[3] / det, -A[1] / det, -A[1] / det, A[0] / det, 1. / A[4]};
    const auto   product = [](const Tensor &a, const Tensor &b) {
      return Tensor{a[0] * b[0] + a[1] * b[2],
                    a[0] * b[1] + a[1] * b[3],
                    a[2] * b[0] + a[3] * b[2],
                    a[2] * b[1] + a[3] * b[3],
                    a[4] * b[4]};
    };
    const Tensor Fe    = product(F, G);
    const double plane = Fe[0] * Fe[3] - Fe[1] * Fe[2], J = plane * Fe[4];
    const Tensor H{
      Fe[3] / plane, -Fe[2] / plane, -Fe[1] / plane, Fe[0] / plane, 1. / Fe[4]};
    double I1 = 0.;
    for (const double f : Fe)
      I1 += f * f;
    Tensor P;
    for (int i = 0; i < 5; ++i)
      P[i] = 2. * c10 * std::pow(J, -2. / 3.) * (Fe[i] - I1 / 3. * H[i]) +
             2. * K * (J - 1.) * J * H[i];
    return product(P, G); // P_e F_a^-T, det F_a = 1
  }

  /// -Div P in the reference shape, N/m^3; differences of sixth order.
  Point
  body_force(const Case &c, const Point &x)
  {
    const double h = 2e-3, weights[3] = {45. / 60., -9. / 60., 1. / 60.};
    Tensor       d_r{}, d_y{};
    for (int k = 1; k <= 3; ++k)
      for (const int sign : {1, -1})
        {
          const Tensor r = stress(c, {x.r + sign * k * h, x.y});
          const Tensor y = stress(c, {x.r, x.y + sign * k * h});
          for (int i = 0; i < 5; ++i)
            {
              d_r[i] += sign * weights[k - 1] / h * r[i];
              d_y[i] += sign * weights[k - 1] / h * y[i];
            }
        }
    const Tensor P = stress(c, x);
    return {-(d_r[0] + d_y[1] + (P[0] - P[4]) / x.r),
            -(d_r[2] + d_y[3] + P[2] / x.r)};
  }

  /// Equilibrium of the body under the manufactured force.
  class Problem : public NonlinearProblem
  {
  public:
    Problem(ElasticityOperator &op, const Case &c)
      : op(op)
      , force(op.n_unknowns(), 0.)
    {
      const auto                       &patch = op.patch();
      const int                         n     = patch.degree(0) + 4;
      const splines::PatchQuadrature<2> quadrature(patch, {{n, n}});
      for (int e = 0; e < quadrature.n_elements(); ++e)
        for (int q = 0; q < quadrature.n_points(); ++q)
          {
            const auto   theta = quadrature.theta(e, q);
            const Point  x     = patch.point(theta);
            const auto   g     = patch.tangents(theta);
            const double w     = 2. * M_PI * x.r * quadrature.weight(e, q) *
                             std::abs(g[0].r * g[1].y - g[0].y * g[1].r);
            const Point b = body_force(c, x);
            for (int a = 0; a < quadrature.n_local(); ++a)
              {
                const int    i = 2 * quadrature.control_points(e)[a];
                const double R = quadrature.values(e, q)[a];
                force[i] += w * R * b.r;
                force[i + 1] += w * R * b.y;
              }
          }
    }

    Evaluation
    residual(const std::vector<double> &x, std::vector<double> &r) override
    {
      return finish(op.residual(x, r), r);
    }
    Evaluation
    residual_and_tangent(const std::vector<double>    &x,
                         std::vector<double>          &r,
                         linear_algebra::SparseMatrix &tangent) override
    {
      return finish(op.residual_and_tangent(x, r, tangent, 1., 0.), r);
    }
    void
    complete(std::vector<double> &correction) const override
    {
      op.get_constraints().complete(correction);
    }

  private:
    Evaluation
    finish(const ElasticityOperator::Evaluation &evaluation,
           std::vector<double>                  &r) const
    {
      for (std::size_t i = 0; i < r.size(); ++i)
        r[i] -= force[i];
      op.get_constraints().condense(r);
      return {evaluation.smallest_J > 0., "folded", evaluation.scale, 0.};
    }

    ElasticityOperator &op;
    std::vector<double> force;
  };

  test::FieldErrors
  solve(const Case &c, const int degree, const int n)
  {
    const auto                     patch = c.patch(degree, n);
    ElasticityOperator::Parameters prm;
    prm.material      = {c10, K, false};
    prm.active_strain = c.active;
    for (const splines::Side side : c.fixed)
      {
        auto &condition        = prm.sides[static_cast<int>(side)];
        condition.fixed        = {{true, true}};
        condition.displacement = {
          {Expression(radial_formula, SideCondition::variables),
           Expression(axial_formula, SideCondition::variables)}};
      }
    ElasticityOperator op(prm, patch, MPI_COMM_WORLD);
    op.set_time(0.);
    op.set_activation(std::vector<double>(op.activation_points().size(), 1.));
    std::vector<double> u;
    for (const Point &x : patch.control_points())
      {
        const Point start = exact(x).u;
        u.push_back(start.r);
        u.push_back(start.y);
      }
    op.get_constraints().apply(u);
    auto pattern = op.sparsity_pattern();
    pattern.compress();
    Newton::Parameters parameters;
    parameters.tolerance = 1e-12;
    Newton     newton(parameters, pattern, MPI_COMM_WORLD, "test");
    Problem    problem(op, c);
    const auto status = newton.solve(problem, u);
    BOOST_TEST(status.success, status.reason);
    return test::field_errors(patch, u, exact, prm.material);
  }

  void
  check_orders(const Case &c, const int degree, const int n)
  {
    const auto   coarse = solve(c, degree, n), fine = solve(c, degree, 2 * n);
    const double l2     = std::log2(coarse.l2 / fine.l2);
    const double energy = std::log2(coarse.energy / fine.energy);
    BOOST_TEST_MESSAGE(c.name << ", degree " << degree << ", " << n << " and "
                              << 2 * n << " elements: L2 errors " << coarse.l2
                              << ", " << fine.l2 << ", order " << l2
                              << "; energy " << coarse.energy << ", "
                              << fine.energy << ", order " << energy);
    BOOST_TEST(l2 > degree + 0.85);
    BOOST_TEST(energy > degree - 0.15);
  }

  const std::vector<splines::Side> around_the_axis{
    splines::Side::theta1_1, splines::Side::theta2_0, splines::Side::theta2_1};

  /// Non-orthogonal, with elements at the axis.
  Case
  passive()
  {
    return {"passive ellipsoid",
            [](const int p, const int n) {
              return test::hollow_ellipsoid({0.7, 0.4}, {1., 0.9}, p, {n, n});
            },
            {},
            [](const Point &) {
              return Tensor{1., 0., 0., 1., 1.};
            },
            around_the_axis};
  }

  /// A shell that shortens alike along all fibres tangential to the sphere, with
  /// elements at the axis; f_a = (1 + theta2^2)/2.
  Case
  unit_directors()
  {
    ActiveStrain::Parameters prm;
    prm.form = ActiveStrain::Form::unit_directors;
    prm.a1 = prm.a3 = 0.3;
    prm.pattern.emplace("0.5*(1 + theta2^2)",
                        std::vector<std::string>{"theta1", "theta2"});
    return {"active sphere, unit directors",
            [](const int p, const int n) {
              return test::hollow_sphere(0.5, 1., p, {n, n});
            },
            prm,
            [](const Point &x) {
              const double R = std::hypot(x.r, x.y), theta2 = (R - 0.5) / 0.5;
              const double along = 1. - 0.3 * 0.5 * (1. + theta2 * theta2);
              const double d     = 1. / (along * along) - along;
              const double n[2]  = {x.r / R, x.y / R};
              return Tensor{along + d * n[0] * n[0],
                            d * n[0] * n[1],
                            d * n[1] * n[0],
                            along + d * n[1] * n[1],
                            along};
            },
            around_the_axis};
  }

  /// A tube of length 1 m: g^1 = e_y / 1 m, g^3 = e_hoop / r.
  Case
  paper_metric()
  {
    ActiveStrain::Parameters prm;
    prm.form      = ActiveStrain::Form::paper_metric;
    prm.a1        = 0.1;
    prm.a3        = 0.05;
    prm.length    = 1.;
    prm.cut_start = prm.cut_end = 0.;
    prm.pattern.emplace("0.5*(1 + theta1^2)",
                        std::vector<std::string>{"theta1", "theta2"});
    return {"active tube, paper metric",
            [](const int p, const int n) {
              return test::tube(0.5, 1., 1., p, {n, n});
            },
            prm,
            [](const Point &x) {
              const double f     = 0.5 * (1. + x.y * x.y);
              const double axial = 1. - 0.1 * f,
                           hoop  = 1. - 0.05 * f / (x.r * x.r);
              return Tensor{1. / (axial * hoop), 0., 0., axial, hoop};
            },
            {all_sides.begin(), all_sides.end()}};
  }
} // namespace

BOOST_AUTO_TEST_SUITE(manufactured)

BOOST_AUTO_TEST_CASE(finite_strain)
{
  for (const Case &c : {passive(), unit_directors(), paper_metric()})
    for (int degree = 2; degree <= 4; ++degree)
      check_orders(c, degree, 8);
}

BOOST_AUTO_TEST_CASE(long_finite_strain_refined)
{
  for (const Case &c : {passive(), unit_directors(), paper_metric()})
    for (int degree = 2; degree <= 4; ++degree)
      check_orders(c, degree, 16);
}

BOOST_AUTO_TEST_SUITE_END()
