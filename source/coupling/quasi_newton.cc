#include "ephyra/coupling/quasi_newton.h"

#include <Eigen/Dense>

#include <cmath>

namespace ephyra::coupling
{
  namespace
  {
    using ConstMap = Eigen::Map<const Eigen::VectorXd>;

    ConstMap
    view(const std::vector<double> &x)
    {
      return ConstMap(x.data(), static_cast<Eigen::Index>(x.size()));
    }
  } // namespace

  QuasiNewton::QuasiNewton(const Parameters &parameters)
    : parameters(parameters)
  {
  }

  void
  QuasiNewton::start_step()
  {
    current.clear();
    old_residual.clear();
    old_answer.clear();
  }

  std::vector<double>
  QuasiNewton::next(const std::vector<double> &x,
                    const std::vector<double> &answer)
  {
    const std::size_t   n = x.size();
    std::vector<double> residual(n);
    for (std::size_t i = 0; i < n; ++i)
      residual[i] = answer[i] - x[i];

    if (!old_residual.empty())
      {
        Difference difference{residual, answer};
        for (std::size_t i = 0; i < n; ++i)
          {
            difference.residual[i] -= old_residual[i];
            difference.answer[i] -= old_answer[i];
          }
        current.push_back(std::move(difference));
      }
    old_residual = residual;
    old_answer   = answer;

    // Newest differences first; those that add nothing new are left out.
    std::vector<const Difference *> candidates;
    for (auto d = current.rbegin(); d != current.rend(); ++d)
      candidates.push_back(&*d);
    for (const auto &step : earlier)
      for (auto d = step.rbegin(); d != step.rend(); ++d)
        candidates.push_back(&*d);

    std::vector<Eigen::VectorXd>    q; // orthonormal
    std::vector<Eigen::VectorXd>    r; // columns of the triangular factor
    std::vector<const Difference *> kept;
    for (const Difference *candidate : candidates)
      {
        if (q.size() >= n)
          break;
        Eigen::VectorXd column = view(candidate->residual);
        const double    length = column.norm();
        if (!(length > 0))
          continue;
        Eigen::VectorXd coefficients(static_cast<Eigen::Index>(q.size()) + 1);
        coefficients.setZero();
        for (int pass = 0; pass < 2; ++pass) // twice is enough
          for (std::size_t k = 0; k < q.size(); ++k)
            {
              const double c = q[k].dot(column);
              coefficients[static_cast<Eigen::Index>(k)] += c;
              column -= c * q[k];
            }
        const double rest = column.norm();
        if (rest < parameters.filter * length)
          continue;
        coefficients[static_cast<Eigen::Index>(q.size())] = rest;
        q.push_back(column / rest);
        r.push_back(coefficients);
        kept.push_back(candidate);
      }

    std::vector<double> result(n);
    if (kept.empty())
      {
        for (std::size_t i = 0; i < n; ++i)
          result[i] = x[i] + parameters.initial_relaxation * residual[i];
        return result;
      }

    // Solve R c = -Q^T residual from the last row up.
    const auto      m = static_cast<Eigen::Index>(kept.size());
    Eigen::VectorXd c(m);
    for (Eigen::Index k = 0; k < m; ++k)
      c[k] = -q[static_cast<std::size_t>(k)].dot(view(residual));
    for (Eigen::Index k = m - 1; k >= 0; --k)
      {
        for (Eigen::Index l = k + 1; l < m; ++l)
          c[k] -= r[static_cast<std::size_t>(l)][k] * c[l];
        c[k] /= r[static_cast<std::size_t>(k)][k];
      }

    result = answer;
    for (Eigen::Index k = 0; k < m; ++k)
      {
        const auto &w = kept[static_cast<std::size_t>(k)]->answer;
        for (std::size_t i = 0; i < n; ++i)
          result[i] += c[k] * w[i];
      }
    return result;
  }

  void
  QuasiNewton::finish_step(const bool accepted)
  {
    if (accepted && !current.empty() && parameters.reused_steps > 0)
      {
        earlier.push_front(std::move(current));
        while (static_cast<int>(earlier.size()) > parameters.reused_steps)
          earlier.pop_back();
      }
    current.clear();
  }

  double
  QuasiNewton::relaxation() const
  {
    return current.empty() && earlier.empty() ? parameters.initial_relaxation
                                              : 1.;
  }

  void
  QuasiNewton::serialize(Archive &archive)
  {
    auto n_steps = static_cast<std::int64_t>(earlier.size());
    archive.value("steps", n_steps);
    earlier.resize(static_cast<std::size_t>(n_steps));
    for (std::size_t s = 0; s < earlier.size(); ++s)
      {
        const Archive::Group group(archive, "step " + std::to_string(s));
        auto n_differences = static_cast<std::int64_t>(earlier[s].size());
        archive.value("differences", n_differences);
        earlier[s].resize(static_cast<std::size_t>(n_differences));
        for (std::size_t d = 0; d < earlier[s].size(); ++d)
          {
            archive.values("residual " + std::to_string(d),
                           earlier[s][d].residual);
            archive.values("answer " + std::to_string(d), earlier[s][d].answer);
          }
      }
  }
} // namespace ephyra::coupling
