#include "ephyra/splines/nested_patch.h"

#include "ephyra/base/exceptions.h"

namespace ephyra::splines
{
  namespace
  {
    NurbsPatch<1>
    nest(const NurbsPatch<1> &side, const int n_parts, const int degree)
    {
      EphyraThrowIf(degree < side.degree(0),
                    InputError,
                    "A nested patch of degree "
                      << degree << " cannot keep the geometry of its parent of "
                      << "degree " << side.degree(0)
                      << "; use at least that degree.");
      return side.with_elevated_degree(0, degree - side.degree(0))
        .with_split_elements(0, n_parts);
    }
  } // namespace

  NestedPatch::NestedPatch(const NurbsPatch<2> &parent,
                           const Side           side,
                           const int            n_parts,
                           const int            degree)
    : parent(parent)
    , side(side)
    , nested(nest(parent.side(side), n_parts, degree))
  {
  }

  EvaluationMatrix
  NestedPatch::parent_field(const std::vector<double> &theta) const
  {
    return EvaluationMatrix::on_side(parent, side, theta);
  }

  EvaluationMatrix
  NestedPatch::parent_field(const PatchQuadrature<1> &nested_points) const
  {
    std::vector<double> theta;
    for (int e = 0; e < nested_points.n_elements(); ++e)
      for (int q = 0; q < nested_points.n_points(); ++q)
        theta.push_back(nested_points.theta(e, q)[0]);
    return parent_field(theta);
  }

  EvaluationMatrix
  NestedPatch::nested_field(const PatchQuadrature<2> &parent_points) const
  {
    const int along = side == Side::theta2_0 || side == Side::theta2_1 ? 0 : 1;
    std::vector<std::array<double, 1>> theta;
    for (int e = 0; e < parent_points.n_elements(); ++e)
      for (int q = 0; q < parent_points.n_points(); ++q)
        theta.push_back({{parent_points.theta(e, q)[along]}});
    return EvaluationMatrix(nested, theta);
  }
} // namespace ephyra::splines
