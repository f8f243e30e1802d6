// The forcing where viscosity is implicit: the matrix B among the markers.
#include "ephyra/immersed_boundary/direct_forcing.h"

#include <algorithm>
#include <array>

namespace ephyra::immersed_boundary
{
  namespace
  {
    /// nu h (1 / Delta_r^2 + 1 / Delta_y^2) of a stage as long as explicit
    /// viscosity allows.
    constexpr double reference_number = 0.2;
  } // namespace

  Eigen::MatrixXd
  DirectForcing::viscous_matrix(const fluid::FlowSolver &flow,
                                const unsigned int       stage,
                                const int                component) const
  {
    // The rows and columns of the grid that hold nodes, numbered.
    const auto number = [](std::vector<int> &list) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    std::vector<int> rows, columns;
    for (const Nodes &node : nodes[component])
      {
        rows.insert(rows.end(), node.phi.row.begin(), node.phi.row.end());
        columns.insert(
          columns.end(), node.phi.column.begin(), node.phi.column.end());
      }
    number(rows);
    number(columns);
    using RowMajor =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto response = [&](const bool along_r, const std::vector<int> &at) {
      const auto n = static_cast<Eigen::Index>(at.size());
      return RowMajor(Eigen::Map<const RowMajor>(
        flow.line_response(stage, component, along_r, at).data(), n, n));
    };
    const RowMajor in_r = response(true, rows), in_y = response(false, columns);

    // Places of the nodes of each marker in the two lists.
    const int                                               n = n_markers();
    std::vector<std::array<std::array<Eigen::Index, 3>, 2>> place(n);
    const auto find = [](const std::vector<int> &list, const int node) {
      return std::lower_bound(list.begin(), list.end(), node) - list.begin();
    };
    for (int l = 0; l < n; ++l)
      for (int a = 0; a < 3; ++a)
        {
          place[l][0][a] = find(rows, nodes[component][l].phi.row[a]);
          place[l][1][a] = find(columns, nodes[component][l].phi.column[a]);
        }

    Eigen::MatrixXd     G(n, n);
    std::vector<double> to_r(3 * rows.size());
    for (int m = 0; m < n; ++m)
      {
        // The forces of marker m behind the operator along r, in all rows.
        const Nodes &from = nodes[component][m];
        for (std::size_t i = 0; i < rows.size(); ++i)
          for (int b = 0; b < 3; ++b)
            {
              double sum = 0;
              for (int a = 0; a < 3; ++a)
                sum += in_r(static_cast<Eigen::Index>(i), place[m][0][a]) *
                       from.spread[3 * a + b];
              to_r[3 * i + b] = sum;
            }
        for (int l = 0; l < n; ++l)
          {
            const Stencil &to  = nodes[component][l].phi;
            double         sum = 0;
            for (int b = 0; b < 3; ++b)
              {
                double along_r[3] = {0, 0, 0};
                for (int a = 0; a < 3; ++a)
                  for (int k = 0; k < 3; ++k)
                    along_r[k] += to.value[a][b] * to_r[3 * place[l][0][a] + k];
                for (int k = 0; k < 3; ++k)
                  sum += in_y(place[l][1][b], place[m][1][k]) * along_r[k];
              }
            G(l, m) = sum;
          }
      }
    return G;
  }

  void
  DirectForcing::prepare(const fluid::FlowSolver &flow,
                         const unsigned int       stage)
  {
    present_viscous = nullptr;
    if (!flow.implicit_directions().any())
      return;
    const double step = flow.stage_dt(stage);
    const double nu   = flow.viscosity() / flow.density();
    for (const auto &known : viscous)
      if (known->step == step)
        present_viscous = known.get();
    if (present_viscous != nullptr)
      return;
    const int       n = n_markers();
    Eigen::VectorXd share(n);
    for (int l = 0; l < n; ++l)
      share[l] = std::min(1., reference_number / (nu * step * rate[l]));
    auto made  = std::make_unique<Viscous>();
    made->step = step;
    for (int c = 0; c < 2; ++c)
      {
        const Matrix         &T = transfer(c);
        const Eigen::MatrixXd B =
          viscous_matrix(flow, stage, c) * T +
          share.asDiagonal() *
            (Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd(M[c] * T));
        made->B[c].compute(B);
      }
    viscous.push_back(std::move(made));
    present_viscous = viscous.back().get();
  }

  DirectForcing::Matrix
  DirectForcing::forces(const int component, const Matrix &R) const
  {
    if (present_viscous == nullptr)
      return transfer(component) * R;
    const Eigen::MatrixXd behind =
      present_viscous->B[component].solve(Eigen::MatrixXd(R));
    return Eigen::MatrixXd(transfer(component) * behind).sparseView(1., 0.);
  }
} // namespace ephyra::immersed_boundary
