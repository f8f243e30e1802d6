#include "ephyra/splines/control_vector.h"

namespace ephyra::splines
{
  template <int dim>
  std::vector<double>
  control_vector(const NurbsPatch<dim> &patch)
  {
    std::vector<double> x;
    x.reserve(2 * patch.control_points().size());
    for (const Point &p : patch.control_points())
      {
        x.push_back(p.r);
        x.push_back(p.y);
      }
    return x;
  }

  template std::vector<double>
  control_vector(const NurbsPatch<1> &);
  template std::vector<double>
  control_vector(const NurbsPatch<2> &);
} // namespace ephyra::splines
