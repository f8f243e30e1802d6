#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/linear_algebra/direct_solver.h"
#include "ephyra/linear_algebra/krylov_solver.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;
using namespace ephyra::linear_algebra;

namespace
{
  using Storage = SparseMatrix::Storage;

  /// Chain of elements that couple `width` neighbouring unknowns; closed to a
  /// ring on request.
  std::vector<std::vector<int>>
  chain(const int n, const int width, const bool ring = false)
  {
    std::vector<std::vector<int>> elements;
    for (int e = 0; e < (ring ? n : n - width + 1); ++e)
      {
        std::vector<int> unknowns;
        for (int k = 0; k < width; ++k)
          unknowns.push_back((e + k) % n);
        elements.push_back(unknowns);
      }
    return elements;
  }

  SparsityPattern
  pattern_of(const int n, const std::vector<std::vector<int>> &elements)
  {
    SparsityPattern pattern(n);
    for (const auto &element : elements)
      pattern.add_element(element);
    pattern.compress();
    return pattern;
  }

  /// Assembles a non-symmetric, diagonally dominant matrix; ranks of the
  /// communicator share the elements.
  void
  assemble(SparseMatrix                        &matrix,
           const std::vector<std::vector<int>> &elements,
           const double                         shift)
  {
    const MPI_Comm comm = matrix.communicator();
    matrix.begin_assembly();
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (static_cast<int>(e) % mpi::size(comm) == mpi::rank(comm))
        {
          const int           n = static_cast<int>(elements[e].size());
          std::vector<double> values(n * n);
          for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
              values[i * n + j] =
                std::sin(1. + i + 3 * j + 0.1 * e) + (i == j ? n + shift : 0.);
          matrix.add(elements[e].data(), n, values.data());
        }
    matrix.finish_assembly();
  }

  std::vector<double>
  some_vector(const int n)
  {
    std::vector<double> x(n);
    for (int i = 0; i < n; ++i)
      x[i] = std::cos(0.7 * i);
    return x;
  }

  double
  distance(const std::vector<double> &a, const std::vector<double> &b)
  {
    BOOST_REQUIRE(a.size() == b.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
  }

  struct Case
  {
    Storage  storage;
    MPI_Comm comm;
  };
  std::vector<Case>
  cases()
  {
    return {{Storage::tpetra, MPI_COMM_WORLD},
            {Storage::tpetra, MPI_COMM_SELF},
            {Storage::band, MPI_COMM_WORLD},
            {Storage::band, MPI_COMM_SELF}};
  }

  bool
  mentions(const std::exception &error, const std::string &text)
  {
    return std::string(error.what()).find(text) != std::string::npos;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(linear_algebra_suite)

BOOST_AUTO_TEST_CASE(pattern)
{
  const SparsityPattern  pattern = pattern_of(6, {{0, 2, -1}, {2, 3}, {5}});
  const std::vector<int> row_2{0, 2, 3}, none;
  BOOST_TEST(pattern.columns[2] == row_2);
  BOOST_TEST(pattern.columns[4] == none);
  BOOST_TEST(pattern.half_bandwidth() == 2);
}

BOOST_AUTO_TEST_CASE(storages_agree_with_a_dense_product)
{
  for (const bool ring : {false, true})
    {
      const int  n        = 37;
      const auto elements = chain(n, 4, ring);
      const auto pattern  = pattern_of(n, elements);

      // Dense reference with the formula of assemble().
      std::vector<double> dense(n * n, 0.);
      for (std::size_t e = 0; e < elements.size(); ++e)
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j)
            dense[elements[e][i] * n + elements[e][j]] +=
              std::sin(1. + i + 3 * j + 0.1 * e) + (i == j ? 4 + 0.5 : 0.);
      const std::vector<double> x = some_vector(n);
      std::vector<double>       expected(n, 0.), norms(n, 0.), y;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          {
            expected[i] += dense[i * n + j] * x[j];
            norms[i] = std::max(norms[i], std::abs(dense[i * n + j]));
          }
      for (const Case &c : cases())
        {
          SparseMatrix matrix(pattern, c.storage, c.comm);
          assemble(matrix, elements, 0.5);
          assemble(matrix, elements, 0.5); // begins from zero again
          matrix.multiply(x, y);
          BOOST_TEST(distance(y, expected) < 1e-13);
          BOOST_TEST(distance(matrix.row_norms(), norms) < 1e-14);
        }
    }
}

BOOST_AUTO_TEST_CASE(constrained_unknowns_are_skipped)
{
  const SparsityPattern pattern = pattern_of(3, {{0, 1}, {1, 2}});
  for (const Case &c : cases())
    {
      SparseMatrix matrix(pattern, c.storage, c.comm);
      matrix.begin_assembly();
      const int    unknowns[] = {-1, 1};
      const double values[]   = {1, 2, 3, 4};
      if (mpi::rank(c.comm) == 0)
        {
          matrix.add(unknowns, 2, values);
          matrix.add(-1, 1, 5.);
          matrix.add(2, 1, 7.);
        }
      matrix.finish_assembly();
      std::vector<double>       y;
      const std::vector<double> expected{0, 4, 7};
      matrix.multiply({1, 1, 1}, y);
      BOOST_TEST(distance(y, expected) == 0.);
    }
}

BOOST_AUTO_TEST_CASE(entries_outside_the_pattern_are_refused)
{
  const SparsityPattern pattern   = pattern_of(50, chain(50, 2));
  const int             far[]     = {3, 20};
  const double          values[4] = {1, 1, 1, 1};
  for (const Case &c : cases())
    {
      SparseMatrix matrix(pattern, c.storage, c.comm);
      matrix.begin_assembly();
      BOOST_CHECK_THROW(matrix.add(3, 20, 1.), InputError);
      BOOST_CHECK_THROW(matrix.add(far, 2, values), InputError);
    }
}

BOOST_AUTO_TEST_CASE(direct_solve_and_new_values)
{
  for (const bool ring : {false, true})
    for (const Case &c : cases())
      {
        const int    n        = 150;
        const auto   elements = chain(n, 5, ring);
        SparseMatrix matrix(pattern_of(n, elements), c.storage, c.comm);
        const auto   solver = make_direct_solver(c.storage, "the test");
        for (const double shift : {0.3, 2.})
          {
            assemble(matrix, elements, shift);
            solver->factorize(matrix);
            const std::vector<double> x = some_vector(n);
            std::vector<double>       b, solution, residual;
            matrix.multiply(x, b);
            solver->solve(b, solution);
            BOOST_TEST(distance(solution, x) < 1e-12);
            matrix.multiply(solution, residual);
            BOOST_TEST(distance(residual, b) < 1e-12);
          }
      }
}

BOOST_AUTO_TEST_CASE(symmetric_matrices)
{
  // Positive definite, indefinite, and not quite symmetric.
  const int  n        = 60;
  const auto elements = chain(n, 4);
  for (const double diagonal : {6., 0.3})
    for (const double skew : {0., 1e-6})
      {
        SparseMatrix matrix(
          pattern_of(n, elements), Storage::band, MPI_COMM_SELF);
        matrix.begin_assembly();
        for (std::size_t e = 0; e < elements.size(); ++e)
          for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
              matrix.add(elements[e][i],
                         elements[e][j],
                         i == j ? diagonal
                                : std::sin(1. + i + j + 0.1 * e) +
                                    (i < j ? skew : 0.));
        matrix.finish_assembly();
        const auto solver = make_direct_solver(Storage::band, "test");
        solver->factorize(matrix);
        const std::vector<double> x = some_vector(n);
        std::vector<double>       b, solution;
        matrix.multiply(x, b);
        solver->solve(b, solution);
        BOOST_TEST(distance(x, solution) < 1e-11);
      }
}

BOOST_AUTO_TEST_CASE(pivoting)
{
  // Zero diagonal: needs row exchanges.
  const int       n = 80;
  SparsityPattern pattern(n);
  for (int i = 0; i < n; i += 2)
    pattern.add_element({i, i + 1});
  pattern.compress();
  for (const Case &c : cases())
    {
      SparseMatrix matrix(pattern, c.storage, c.comm);
      matrix.begin_assembly();
      if (mpi::rank(c.comm) == 0)
        for (int i = 0; i < n; i += 2)
          {
            matrix.add(i, i + 1, 2.);
            matrix.add(i + 1, i, 3.);
          }
      matrix.finish_assembly();
      const auto solver = make_direct_solver(c.storage, "the test");
      solver->factorize(matrix);
      std::vector<double> x;
      solver->solve(std::vector<double>(n, 6.), x);
      BOOST_TEST(std::abs(x[0] - 2.) < 1e-15);
      BOOST_TEST(std::abs(x[1] - 3.) < 1e-15);
    }
}

BOOST_AUTO_TEST_CASE(singular_matrices_are_refused)
{
  // A chain of springs that nothing holds; then one without an equation; then
  // one with a value that is not finite.
  const int n = 40;
  for (const Case &c : cases())
    {
      const auto   elements = chain(n, 2);
      SparseMatrix matrix(pattern_of(n, elements), c.storage, c.comm);
      const auto   springs = [&](const double stiffness, const int first) {
        matrix.begin_assembly();
        if (mpi::rank(c.comm) == 0)
          for (std::size_t e = first; e < elements.size(); ++e)
            {
              const double k = stiffness * (1 + 0.1 * std::sin(3. * e));
              const double values[] = {k, -k, -k, k};
              matrix.add(elements[e].data(), 2, values);
            }
        matrix.finish_assembly();
      };
      const auto solver = make_direct_solver(c.storage, "the chain");
      for (const double stiffness : {1., 1e-9, 1e9})
        {
          springs(stiffness, 0);
          BOOST_CHECK_EXCEPTION(solver->factorize(matrix),
                                DivergedError,
                                [](const DivergedError &e) {
                                  return mentions(e, "the chain is singular") &&
                                         mentions(e, "check supports");
                                });
        }
      springs(1., 1);
      BOOST_CHECK_EXCEPTION(
        solver->factorize(matrix), DivergedError, [](const DivergedError &e) {
          return mentions(e, "unknown 0 has no equation");
        });
      springs(std::nan(""), 0);
      BOOST_CHECK_EXCEPTION(
        solver->factorize(matrix), DivergedError, [](const DivergedError &e) {
          return mentions(e, "not finite in row 0");
        });
      // The solver recovers.
      assemble(matrix, elements, 1.);
      solver->factorize(matrix);
    }
}

BOOST_AUTO_TEST_CASE(storage_choice)
{
  const auto narrow = pattern_of(1200, chain(1200, 4));
  const auto ring   = pattern_of(1200, chain(1200, 4, true));
  BOOST_CHECK(preferred_storage(narrow) == Storage::band);
  BOOST_CHECK(preferred_storage(ring) == Storage::tpetra);
  BOOST_CHECK(preferred_storage(pattern_of(100, chain(100, 4, true))) ==
              Storage::band);
}

BOOST_AUTO_TEST_CASE(krylov_solvers)
{
  const int  n        = 200;
  const auto elements = chain(n, 2);
  for (const MPI_Comm comm : {MPI_COMM_WORLD, MPI_COMM_SELF})
    for (const std::string method : {"gmres", "cg"})
      for (const std::string preconditioner : {"none", "jacobi"})
        {
          SparseMatrix matrix(pattern_of(n, elements), Storage::tpetra, comm);
          matrix.begin_assembly();
          if (mpi::rank(comm) == 0)
            for (std::size_t e = 0; e < elements.size(); ++e)
              {
                const double k        = 1. + 100. * (e % 7);
                const double values[] = {1.1 * k, -k, -k, 1.2 * k};
                matrix.add(elements[e].data(), 2, values);
              }
          matrix.finish_assembly();
          const std::vector<double> x = some_vector(n);
          std::vector<double>       b, solution;
          matrix.multiply(x, b);

          KrylovSolver::Parameters parameters;
          parameters.method         = method;
          parameters.preconditioner = preconditioner;
          parameters.tolerance      = 1e-12;
          const KrylovSolver solver(parameters, "the chain");
          StepStatus         status = solver.solve(matrix, b, solution);
          BOOST_TEST(status.success);
          BOOST_TEST(status.residual < 1.01e-12);
          BOOST_TEST(status.iterations > 5);
          BOOST_TEST(distance(solution, x) < 1e-8);

          // Too few iterations: a failure that says so.
          parameters.max_iterations = 5;
          solution.clear();
          status =
            KrylovSolver(parameters, "the chain").solve(matrix, b, solution);
          BOOST_TEST(!status.success);
          BOOST_TEST(status.residual > 1e-12);
          BOOST_TEST(status.reason.find("the chain") != std::string::npos);

          status = solver.solve(matrix, std::vector<double>(n, 0.), solution);
          BOOST_TEST(status.success);
          BOOST_TEST(solution[3] == 0.);
        }
}

BOOST_AUTO_TEST_SUITE_END()
