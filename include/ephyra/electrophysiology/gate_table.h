#pragma once

#include <vector>

namespace ephyra::electrophysiology
{
  /// Steady values G_inf(v) and rates 1/tau(v) of up to eight gates as a table
  /// of cubic Hermite polynomials in v. One row holds all gates, so that a
  /// point costs one lookup and vector arithmetic over the gates instead of two
  /// exponentials a gate. The error falls with the fourth power of the
  /// interval.
  class GateTable
  {
  public:
    static constexpr int n_lanes = 8; ///< gates that a row has room for

    /// Fills G_inf and 1/tau of the gates at a potential; n_lanes values each.
    using Rates = void (*)(const void *model,
                           double      v,
                           double     *steady,
                           double     *rate);

    /// An empty table contains nothing.
    GateTable() = default;
    /// @p v and @p interval in the unit of the model.
    GateTable(Rates       rates,
              const void *model,
              double      v_min,
              double      v_max,
              double      interval);

    /// Whether all n potentials, times @p scale, are inside the table.
    bool
    contains(int n, const double *v, double scale) const;

    /// G := add + keep G advances a gate by a step: fills both for n points,
    /// lane k of point i at i * n_lanes + k. Classical Runge-Kutta 4 of
    /// dG/dt = (G_inf - G)/tau, or with @p exact its exact solution, which is
    /// stable for any step.
    void
    coefficients(int           n,
                 const double *v,
                 double        scale,
                 double        dt,
                 bool          exact,
                 double       *keep,
                 double       *add) const;

  private:
    static constexpr int n_functions = 2 * n_lanes;
    static constexpr int row_length  = 4 * n_functions;

    double              v_first      = 0;
    double              per_interval = 0;
    int                 n_rows       = 0;
    std::vector<double> rows; ///< four coefficients of all functions
  };
} // namespace ephyra::electrophysiology
