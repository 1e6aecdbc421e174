// SPDX-License-Identifier: MIT
#include "homogenization/fem/homogenize.h"

namespace homespun::homogenization
{
const char *name_of(const CellSolver solver)
{
  switch (solver)
  {
  case CellSolver::fastest:
    return "fastest";
  case CellSolver::direct:
    return "direct";
  case CellSolver::multigrid:
    return "multigrid";
  }
  return "";
}
} // namespace homespun::homogenization
