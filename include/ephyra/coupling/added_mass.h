#pragma once

#include "ephyra/base/archive.h"
#include "ephyra/immersed_boundary/markers.h"
#include "ephyra/linear_algebra/sparse_matrix.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace ephyra::coupling
{
  /// What stands for the answer of the flow in the matrix of the body.
  enum class AddedMassKind
  {
    full,
    lumped,   ///< sum over l of A_kl
    diagonal, ///< A_kk
    forcing   ///< not measured: WetSurface::forcing_resistance()
  };

  /// The measured added-mass operator A of a wetted surface, kg: the load of
  /// the flow on the control points that answers their accelerations, load =
  /// g + A a. It is dense among the wet unknowns. Between measurements it is
  /// carried along with the body: the 2 x 2 block of two control points turns
  /// with the normals of the surface at them,
  ///   A_kl = R_k A_kl^0 R_l^T.
  /// Lumped or diagonal, it is a local impedance of the fluid.
  class AddedMass
  {
  public:
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    /// The wet control points are those that the markers depend on.
    AddedMass(const immersed_boundary::Markers &markers,
              int                               n_control_points,
              AddedMassKind                     kind = AddedMassKind::full);

    /// Unknowns 2 * point + component that A acts on.
    const std::vector<int> &
    unknowns() const
    {
      return wet_unknowns;
    }
    bool
    known() const
    {
      return measured.size() > 0;
    }
    /// Column k: the load on unknowns() for a unit acceleration of
    /// unknowns()[k], at the present normals of the markers.
    void
    set(Eigen::MatrixXd columns, const immersed_boundary::Markers &markers);

    /// A for the present normals, on all unknowns of the body.
    Matrix
    at(const immersed_boundary::Markers &markers) const;

    /// Pairs of unknowns that A couples.
    linear_algebra::SparsityPattern
    pattern() const;

    void
    serialize(Archive &archive);

  private:
    /// Angle of the normal at each wet control point, the mean over the
    /// markers that depend on it, rad.
    std::vector<double>
    angles(const immersed_boundary::Markers &markers) const;

    const int           n_control_points;
    const AddedMassKind kind;
    std::vector<int>    wet_points, wet_unknowns;
    std::vector<int>    index;           ///< of control points in wet_points
    Eigen::MatrixXd     measured;        ///< A^0, empty: unknown
    std::vector<double> measured_angles; ///< normals of A^0
  };
} // namespace ephyra::coupling
