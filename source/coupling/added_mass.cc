#include "ephyra/coupling/added_mass.h"

#include <cmath>

namespace ephyra::coupling
{
  AddedMass::AddedMass(const immersed_boundary::Markers &markers,
                       const int                         n_control_points,
                       const AddedMassKind               kind)
    : n_control_points(n_control_points)
    , kind(kind)
    , index(n_control_points, -1)
  {
    for (const int point : markers.shape().column)
      index[point] = 0;
    for (int point = 0; point < n_control_points; ++point)
      if (index[point] == 0)
        {
          index[point] = static_cast<int>(wet_points.size());
          wet_points.push_back(point);
          wet_unknowns.push_back(2 * point);
          wet_unknowns.push_back(2 * point + 1);
        }
  }

  std::vector<double>
  AddedMass::angles(const immersed_boundary::Markers &markers) const
  {
    const auto         &rows  = markers.shape();
    const auto         &state = markers.state();
    std::vector<double> n_r(wet_points.size(), 0.), n_y(n_r), angle(n_r);
    for (int l = 0; l < rows.n_rows(); ++l)
      for (int k = rows.start[l]; k < rows.start[l + 1]; ++k)
        {
          const int p = index[rows.column[k]];
          if (p < 0) // markers placed anew touch it
            continue;
          n_r[p] += rows.value[k] * state.length[l] * state.n_r[l];
          n_y[p] += rows.value[k] * state.length[l] * state.n_y[l];
        }
    for (std::size_t p = 0; p < angle.size(); ++p)
      angle[p] = std::atan2(n_y[p], n_r[p]);
    return angle;
  }

  void
  AddedMass::set(Eigen::MatrixXd                   columns,
                 const immersed_boundary::Markers &markers)
  {
    measured        = std::move(columns);
    measured_angles = angles(markers);
    if (kind == AddedMassKind::full)
      return;
    for (Eigen::Index k = 0; k < measured.rows(); k += 2)
      {
        Eigen::Matrix2d block = measured.block<2, 2>(k, k);
        if (kind == AddedMassKind::lumped)
          for (Eigen::Index l = 0; l < measured.cols(); l += 2)
            if (l != k)
              block += measured.block<2, 2>(k, l);
        measured.middleRows<2>(k).setZero();
        measured.block<2, 2>(k, k) = block;
      }
  }

  AddedMass::Matrix
  AddedMass::at(const immersed_boundary::Markers &markers) const
  {
    std::vector<double> angle = angles(markers);
    const auto          n     = static_cast<Eigen::Index>(wet_points.size());
    std::vector<Eigen::Matrix2d> turn(angle.size());
    for (std::size_t p = 0; p < angle.size(); ++p)
      {
        const double c = std::cos(angle[p] - measured_angles[p]);
        const double s = std::sin(angle[p] - measured_angles[p]);
        turn[p] << c, -s, s, c;
      }
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(4 * angle.size() * angle.size());
    const bool local = kind != AddedMassKind::full;
    for (Eigen::Index k = 0; k < n; ++k)
      for (Eigen::Index l = local ? k : 0; l < (local ? k + 1 : n); ++l)
        {
          const Eigen::Matrix2d block =
            turn[k] * measured.block<2, 2>(2 * k, 2 * l) * turn[l].transpose();
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              entries.emplace_back(
                2 * wet_points[k] + i, 2 * wet_points[l] + j, block(i, j));
        }
    Matrix result(2 * n_control_points, 2 * n_control_points);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  linear_algebra::SparsityPattern
  AddedMass::pattern() const
  {
    linear_algebra::SparsityPattern result(2 * n_control_points);
    for (const int i : wet_unknowns)
      if (kind == AddedMassKind::full)
        result.columns[i] = wet_unknowns;
      else
        result.columns[i] = {i - i % 2, i - i % 2 + 1};
    return result;
  }

  void
  AddedMass::serialize(Archive &archive)
  {
    std::vector<double> values(measured.data(),
                               measured.data() + measured.size());
    archive.values("operator", values);
    archive.values("angles", measured_angles);
    const auto n = static_cast<Eigen::Index>(wet_unknowns.size());
    if (archive.reading() && values.empty())
      measured.resize(0, 0);
    else if (archive.reading())
      measured = Eigen::Map<const Eigen::MatrixXd>(values.data(), n, n);
  }
} // namespace ephyra::coupling
