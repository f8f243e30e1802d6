#pragma once

#include "ephyra/linear_algebra/direct_solver.h"

namespace ephyra::linear_algebra
{
  std::unique_ptr<DirectSolver>
  make_amesos_solver(const std::string &what);
} // namespace ephyra::linear_algebra
