#include "ephyra/immersed_boundary/no_slip_iteration.h"

#include <Eigen/Dense>

#include <cmath>
#include <sstream>

namespace ephyra::immersed_boundary
{
  namespace
  {
    using Vector = Eigen::VectorXd;

    Vector
    to_eigen(const std::vector<double> &v)
    {
      return Eigen::Map<const Vector>(v.data(),
                                      static_cast<Eigen::Index>(v.size()));
    }
    std::vector<double>
    to_std(const Vector &v)
    {
      return std::vector<double>(v.data(), v.data() + v.size());
    }
  } // namespace

  StepStatus
  converge_no_slip(fluid::FlowSolver         &flow,
                   const unsigned int         stage,
                   const DirectForcing       &forcing,
                   const std::vector<double> &target,
                   const double               tolerance,
                   const int                  most_iterations,
                   std::vector<double>       &F)
  {
    const auto projected = [&](const Vector &force) {
      flow.reset_to_predicted(stage);
      forcing.add(to_std(force), flow, stage);
      flow.project(stage);
      std::vector<double> Ju;
      forcing.interpolate(flow.velocity(), Ju);
      return to_eigen(Ju);
    };
    const auto precondition = [&](const Vector &z) {
      std::vector<double> force;
      forcing.solve(to_std(z), force);
      return to_eigen(force);
    };

    const Vector F0       = to_eigen(F);
    const Vector unforced = projected(Vector::Zero(F0.size()));
    const Vector V        = to_eigen(target);
    const double size     = std::sqrt(0.5 * static_cast<double>(V.size()));
    const Vector r0       = V - projected(F0);
    const int    n        = most_iterations;

    StepStatus status;
    status.residual = r0.norm() / size;
    if (status.residual <= tolerance)
      return status;

    // Arnoldi's basis, and the Hessenberg matrix made triangular by Givens
    // rotations as it grows.
    Eigen::MatrixXd basis(F0.size(), n + 1), H(n + 1, n);
    Vector          g = Vector::Zero(n + 1), cosine(n), sine(n);
    H.setZero();
    g[0]         = r0.norm();
    basis.col(0) = r0 / g[0];
    int k        = 0;
    while (k < n && std::abs(g[k]) > tolerance * size)
      {
        Vector w = projected(precondition(basis.col(k))) - unforced;
        for (int i = 0; i <= k; ++i)
          {
            H(i, k) = basis.col(i).dot(w);
            w -= H(i, k) * basis.col(i);
          }
        H(k + 1, k) = w.norm();
        if (H(k + 1, k) > 0)
          basis.col(k + 1) = w / H(k + 1, k);
        for (int i = 0; i < k; ++i)
          {
            const double upper = H(i, k);
            H(i, k)            = cosine[i] * upper + sine[i] * H(i + 1, k);
            H(i + 1, k)        = -sine[i] * upper + cosine[i] * H(i + 1, k);
          }
        const double length = std::hypot(H(k, k), H(k + 1, k));
        cosine[k]           = H(k, k) / length;
        sine[k]             = H(k + 1, k) / length;
        H(k, k)             = length;
        g[k + 1]            = -sine[k] * g[k];
        g[k] *= cosine[k];
        ++k;
      }
    const Vector y =
      H.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(g.head(k));
    const Vector force = F0 + precondition(basis.leftCols(k) * y);
    const double slip  = (V - projected(force)).norm();
    F                  = to_std(force);

    status.iterations = k;
    status.residual   = slip / size;
    // The last projection confirms what the recurrence has promised.
    if (!(status.residual <= 1.5 * tolerance))
      {
        std::ostringstream text;
        text
          << "The slip at the markers is " << status.residual << " m/s after "
          << k << " iterations, above " << tolerance
          << " m/s: raise 'No-slip iterations' or 'No-slip tolerance', or set "
             "the iterations to 0.";
        return StepStatus::failure(text.str());
      }
    return status;
  }
} // namespace ephyra::immersed_boundary
