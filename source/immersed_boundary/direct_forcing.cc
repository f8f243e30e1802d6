#include "ephyra/immersed_boundary/direct_forcing.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ephyra::immersed_boundary
{
  namespace
  {
    using Vector = Eigen::Map<const Eigen::VectorXd>;

    constexpr double shift_of_exact_solver = 1e-8;
    /// Row sums of M below it are those of markers without a share in nodes.
    constexpr double smallest_sum = 0.1;

    /// r dr and dy of the control volume of a velocity; 0 where it is given.
    double
    radial_size(const fluid::StaggeredGrid &grid,
                const int                   component,
                const int                   i)
    {
      return component == 0 ? grid.r.face[i] * grid.r.centre_gap[i]
                            : grid.r.centre[i] * grid.r.width[i];
    }
    double
    axial_size(const fluid::StaggeredGrid &grid,
               const int                   component,
               const int                   j)
    {
      const fluid::GridLine &y = grid.y;
      if (component == 0)
        return y.width[j];
      if (j > 0 && j < y.n_cells)
        return y.centre_gap[j];
      return grid.periodic_y ? y.centre_gap.front() : 0.;
    }

    /// Lists the markers that spread to a node: open addressing from the node
    /// number to the head of a linked list.
    class MarkersOfNode
    {
    public:
      struct Entry
      {
        int    marker, next;
        double value;
      };

      explicit MarkersOfNode(const std::size_t n_entries)
      {
        // Nodes are shared by many markers: room for all is more than enough.
        std::size_t size = 16;
        while (size <= n_entries)
          size *= 2;
        key.assign(size, -1);
        head.assign(size, -1);
        entries.reserve(n_entries);
      }
      void
      add(const std::int64_t node, const int marker, const double value)
      {
        const std::size_t s = slot(node);
        key[s]              = node;
        entries.push_back({marker, head[s], value});
        head[s] = static_cast<int>(entries.size()) - 1;
      }
      int
      first(const std::int64_t node) const
      {
        return head[slot(node)];
      }
      const Entry &
      operator[](const int i) const
      {
        return entries[i];
      }

    private:
      std::size_t
      slot(const std::int64_t node) const
      {
        const std::size_t mask = key.size() - 1;
        std::size_t       s =
          (static_cast<std::uint64_t>(node) * 0x9E3779B97F4A7C15ull >> 20) &
          mask;
        while (key[s] != node && key[s] != -1)
          s = (s + 1) & mask;
        return s;
      }

      std::vector<std::int64_t> key;
      std::vector<int>          head;
      std::vector<Entry>        entries;
    };
  } // namespace

  struct DirectForcing::Inverse
  {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
    Eigen::VectorXd                                    root_of_scale;

    Eigen::VectorXd
    solve(const Eigen::VectorXd &residual) const
    {
      const Eigen::VectorXd z =
        factors.solve(root_of_scale.cwiseProduct(residual));
      return z.cwiseQuotient(root_of_scale);
    }
  };

  DirectForcing::DirectForcing(const fluid::StaggeredGrid &grid,
                               const Parameters           &parameters)
    : mls(grid, parameters)
    , parameters(parameters)
  {
  }

  DirectForcing::~DirectForcing() = default;

  void
  DirectForcing::update(const Markers &markers)
  {
    markers.check(mls.grid());
    const MarkerState &m = markers.state();
    const int          n = markers.size();
    w.resize(n);
    rate.resize(n);
    viscous.clear();
    present_viscous = nullptr;
    for (int c = 0; c < 2; ++c)
      {
        nodes[c].resize(n);
        scale[c].resize(n);
        T_valid[c] = false;
      }

    for (int l = 0; l < n; ++l)
      {
        MovingLeastSquares::Line rc = mls.r_centres(m.r[l]);
        MovingLeastSquares::Line yc = mls.y_centres(m.y[l]);
        const double eta            = mls.cell_size(rc, yc, m.n_r[l], m.n_y[l]);
        const double r = m.r[l] - parameters.inward_shift * eta * m.n_r[l];
        const double y = m.y[l] - parameters.inward_shift * eta * m.n_y[l];
        EphyraThrowIf(!mls.contains(r, y),
                      DivergedError,
                      "The forcing point ("
                        << r << ", " << y << ") m of body '"
                        << markers.curves()[markers.curve(l)].name
                        << "' lies outside of the flow grid: reduce the "
                           "'Inward shift' or refine the grid.");
        const double shell = r * m.length[l] * eta;
        w[l]               = 2. * M_PI * shell;
        rate[l]            = 1. / std::pow(mls.cell_size(rc, yc, 1., 0.), 2) +
                  1. / std::pow(mls.cell_size(rc, yc, 0., 1.), 2);

        if (parameters.inward_shift > 0)
          {
            rc = mls.r_centres(r);
            yc = mls.y_centres(y);
          }
        nodes[0][l].phi = MovingLeastSquares::value(mls.r_faces(r), yc);
        nodes[1][l].phi = MovingLeastSquares::value(rc, mls.y_faces(y));
        for (int c = 0; c < 2; ++c)
          scale[c][l] = set_spreading(c, shell, nodes[c][l]);
      }
    for (int c = 0; c < 2; ++c)
      assemble(c);
  }

  double
  DirectForcing::set_spreading(const int    component,
                               const double shell,
                               Nodes       &node) const
  {
    const int      n_r = mls.grid().r.n_cells;
    const Stencil &s   = node.phi;
    double         sum = 0;
    for (int a = 0; a < 3; ++a)
      {
        const int    i     = s.row[a];
        const bool   inner = component == 1 || (i > 0 && i < n_r);
        const double r_dr  = radial_size(mls.grid(), component, i);
        for (int b = 0; b < 3; ++b)
          {
            const double dy  = axial_size(mls.grid(), component, s.column[b]);
            const double phi = inner && dy > 0 ? s.value[a][b] : 0.;
            node.spread[3 * a + b] = phi;
            sum += phi * r_dr * dy;
          }
      }
    // A marker next to the axis, or with all nodes prescribed, has no share.
    const double c = sum > 0 ? shell / sum : 0.;
    for (double &value : node.spread)
      value *= c;
    return c;
  }

  void
  DirectForcing::assemble(const int component)
  {
    const int          n       = n_markers();
    const std::int64_t columns = mls.grid().y.n_cells + 1;
    const auto number = [&](const Stencil &s, const int a, const int b) {
      return s.row[a] * columns + s.column[b];
    };
    MarkersOfNode spreading(9 * static_cast<std::size_t>(n));
    for (int l = 0; l < n; ++l)
      for (int k = 0; k < 9; ++k)
        if (const Nodes &node = nodes[component][l]; node.spread[k] != 0)
          spreading.add(number(node.phi, k / 3, k % 3), l, node.spread[k]);

    std::vector<int>    start{0}, column, touched;
    std::vector<double> value, work(n, 0.);
    std::vector<char>   seen(n, 0);
    start.reserve(n + 1);
    column.reserve(16 * static_cast<std::size_t>(n));
    value.reserve(16 * static_cast<std::size_t>(n));
    for (int l = 0; l < n; ++l)
      {
        const Stencil &s = nodes[component][l].phi;
        for (int k = 0; k < 9; ++k)
          for (int e = spreading.first(number(s, k / 3, k % 3)); e >= 0;
               e     = spreading[e].next)
            {
                  const int m = spreading[e].marker;
                  if (!seen[m])
                {
                      seen[m] = 1;
                      touched.push_back(m);
                }
              work[m] += s.value[k / 3][k % 3] * spreading[e].value;
            }
        std::sort(touched.begin(), touched.end());
        for (const int m : touched)
          {
            column.push_back(m);
            value.push_back(work[m]);
            work[m] = 0;
            seen[m] = 0;
          }
        touched.clear();
        start.push_back(static_cast<int>(column.size()));
      }
    M[component] = Eigen::Map<const Matrix>(n,
                                            n,
                                            static_cast<int>(column.size()),
                                            start.data(),
                                            column.data(),
                                            value.data());

    relaxation[component] = Eigen::VectorXd::Ones(n);
    if (parameters.forcing_solver == ForcingSolver::scaled_sweeps)
      for (int l = 0; l < n; ++l)
        if (const double sum = M[component].row(l).sum(); sum > smallest_sum)
          relaxation[component][l] = 1. / sum;
    if (parameters.forcing_solver != ForcingSolver::exact)
      return;
    // C^1/2 Phi Phi^T C^1/2 = C^1/2 M C^-1/2.
    inverse[component] = std::make_unique<Inverse>();
    Inverse &in        = *inverse[component];
    in.root_of_scale.resize(n);
    for (int l = 0; l < n; ++l)
      in.root_of_scale[l] = std::sqrt(std::max(scale[component][l], 1e-12));
    Eigen::SparseMatrix<double> A =
      in.root_of_scale.asDiagonal() * M[component] *
      in.root_of_scale.cwiseInverse().asDiagonal();
    for (int l = 0; l < n; ++l)
      A.coeffRef(l, l) += shift_of_exact_solver;
    in.factors.compute(A);
    EphyraThrowIf(in.factors.info() != Eigen::Success,
                  DivergedError,
                  "The matrix of the marker forces ("
                    << n
                    << " markers) is singular: increase 'Marker spacing' "
                       "or use 'Forcing = sweeps'.");
  }

  void
  DirectForcing::add(const std::vector<double> &F,
                     fluid::FlowSolver         &flow,
                     const unsigned int         stage) const
  {
    flow.add_forces(stage,
                    [&](fluid::VelocityField &field) { spread(F, field); });
  }

  void
  DirectForcing::interpolate(const fluid::VelocityField &velocity,
                             std::vector<double>        &Ju) const
  {
    const fluid::StaggeredGrid &grid = mls.grid();
    const int                   n    = n_markers();
    Ju.assign(2 * n, 0.);
    for (int c = 0; c < 2; ++c)
      {
        const fluid::DistributedArray &u = c == 0 ? velocity.r : velocity.y;
        // The radial velocity on the outer wall is a row of the last rank.
        const int end =
          grid.end_row() + (c == 0 && grid.is_last_rank() ? 1 : 0);
        for (int l = 0; l < n; ++l)
          {
            const Stencil &s   = nodes[c][l].phi;
            double         sum = 0;
            for (int a = 0; a < 3; ++a)
              if (s.row[a] >= grid.first_row && s.row[a] < end)
                {
                  const double *row = u.row(s.row[a]);
                  for (int b = 0; b < 3; ++b)
                    sum += s.value[a][b] * row[s.column[b]];
                }
            Ju[c * n + l] = sum;
          }
      }
    mpi::sum_in_place(Ju, grid.communicator());
  }

  void
  DirectForcing::solve(const std::vector<double> &residual,
                       std::vector<double>       &F) const
  {
    const int n = n_markers();
    F.resize(2 * n);
    for (int c = 0; c < 2; ++c)
      {
        Eigen::Map<Eigen::VectorXd> force(F.data() + c * n, n);
        Eigen::VectorXd             r(Vector(residual.data() + c * n, n));
        if (present_viscous != nullptr)
          r = present_viscous->B[c].solve(r);
        if (parameters.forcing_solver == ForcingSolver::exact)
          {
            force = inverse[c]->solve(r);
            continue;
          }
        force = relaxation[c].cwiseProduct(r);
        for (int sweep = 1; sweep < parameters.forcing_sweeps; ++sweep)
          force += relaxation[c].cwiseProduct(r - M[c] * force);
      }
  }

  void
  DirectForcing::spread(const std::vector<double> &F,
                        fluid::VelocityField      &velocity) const
  {
    const fluid::StaggeredGrid &grid = mls.grid();
    const int                   n    = n_markers();
    for (int c = 0; c < 2; ++c)
      {
        fluid::DistributedArray &u = c == 0 ? velocity.r : velocity.y;
        for (int l = 0; l < n; ++l)
          {
            const Nodes &node  = nodes[c][l];
            const double force = F[c * n + l];
            for (int a = 0; a < 3; ++a)
              if (grid.owns_row(node.phi.row[a]))
                {
                  double *row = u.row(node.phi.row[a]);
                  for (int b = 0; b < 3; ++b)
                    row[node.phi.column[b]] += node.spread[3 * a + b] * force;
                }
          }
      }
  }

  double
  DirectForcing::work(const std::vector<double>  &F,
                      const fluid::VelocityField &before,
                      const fluid::VelocityField &after) const
  {
    const fluid::StaggeredGrid &grid = mls.grid();
    const int                   n    = n_markers();
    double                      sum  = 0;
    for (int c = 0; c < 2; ++c)
      {
        const fluid::DistributedArray &from = c == 0 ? before.r : before.y;
        const fluid::DistributedArray &to   = c == 0 ? after.r : after.y;
        for (int l = 0; l < n; ++l)
          {
            const Nodes &node  = nodes[c][l];
            double       power = 0;
            for (int a = 0; a < 3; ++a)
              {
                const int i = node.phi.row[a];
                if (!grid.owns_row(i))
                  continue;
                const double r_dr = radial_size(grid, c, i);
                for (int b = 0; b < 3; ++b)
                  {
                    const int j = node.phi.column[b];
                    power += node.spread[3 * a + b] * r_dr *
                             axial_size(grid, c, j) * (from(i, j) + to(i, j));
                  }
              }
            sum += F[c * n + l] * power;
          }
      }
    return M_PI * mpi::sum(sum, grid.communicator());
  }

  const DirectForcing::Matrix &
  DirectForcing::transfer(const int component) const
  {
    Matrix &result = T[component];
    if (T_valid[component])
      return result;
    const int n = n_markers();
    if (parameters.forcing_solver == ForcingSolver::exact)
      {
        std::vector<Eigen::Triplet<double>> entries;
        for (int l = 0; l < n; ++l)
          {
            const Eigen::VectorXd column =
              inverse[component]->solve(Eigen::VectorXd::Unit(n, l));
            for (int k = 0; k < n; ++k)
              entries.emplace_back(k, l, column[k]);
          }
        result.resize(n, n);
        result.setFromTriplets(entries.begin(), entries.end());
      }
    else
      {
        Matrix diagonal(n, n), scaled = M[component];
        diagonal.setIdentity();
        for (int l = 0; l < n; ++l)
          {
            diagonal.coeffRef(l, l) = relaxation[component][l];
            scaled.row(l) *= relaxation[component][l];
          }
        result = diagonal; // Horner: T <- D + (I - D M) T
        for (int sweep = 1; sweep < parameters.forcing_sweeps; ++sweep)
          result = diagonal + result - Matrix(scaled * result);
      }
    T_valid[component] = true;
    return result;
  }
} // namespace ephyra::immersed_boundary
