#include "factorization_check.h"

#include "ephyra/base/exceptions.h"

#include <cmath>

namespace ephyra::linear_algebra
{
  std::vector<double>
  check_rows(const SparseMatrix &matrix, const std::string &what)
  {
    std::vector<double> norms = matrix.row_norms();
    for (std::size_t row = 0; row < norms.size(); ++row)
      {
        EphyraThrowIf(!std::isfinite(norms[row]),
                      DivergedError,
                      "The matrix of "
                        << what << " holds a value that is not finite in row "
                        << row << "; a smaller step may help.");
        EphyraThrowIf(norms[row] == 0.,
                      DivergedError,
                      "The matrix of " << what << " is singular: unknown "
                                       << row << " has no equation.");
      }
    return norms;
  }

  void
  check_factors(const DirectSolver        &solver,
                const std::vector<double> &row_norms,
                const std::string         &what)
  {
    // Signs without a pattern, so that no null vector is met at a right angle.
    std::vector<double> right_hand_side(row_norms.size()), solution;
    unsigned int        state = 12345;
    for (std::size_t row = 0; row < row_norms.size(); ++row)
      {
        state                = 1664525u * state + 1013904223u;
        right_hand_side[row] = (state >> 31 ? 1. : -1.) * row_norms[row];
      }
    solver.solve(right_hand_side, solution);
    std::size_t worst = 0;
    for (std::size_t i = 0; i < solution.size(); ++i)
      {
        EphyraThrowIf(!std::isfinite(solution[i]),
                      DivergedError,
                      "The matrix of " << what << " is singular: unknown " << i
                                       << " is not determined; check supports "
                                          "and constraints.");
        if (std::abs(solution[i]) > std::abs(solution[worst]))
          worst = i;
      }
    EphyraThrowIf(!solution.empty() && std::abs(solution[worst]) > 1e13,
                  DivergedError,
                  "The matrix of "
                    << what << " is singular to round-off: unknown " << worst
                    << " is not determined; check supports and constraints.");
  }
} // namespace ephyra::linear_algebra
