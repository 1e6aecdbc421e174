// SPDX-License-Identifier: MIT
#include "verification/method/sheet_solvers.h"

#include <utility>

namespace homespun::verification
{
Law homogenized_law(const Law of_reference, const Eigen::Matrix3d &stiffness)
{
  switch (of_reference)
  {
  case Law::linear:
    return Law::linear;
  case Law::yarn:
    return meshes::yarn_axes(stiffness).are_there ? Law::yarn : Law::biot;
  case Law::biot:
  case Law::green:
    break;
  }
  return Law::biot;
}

SheetSolvers::SheetSolvers(shell::Membrane membrane, std::vector<int> of_held)
    : held(std::move(of_held))
    , corotational(made(std::move(membrane)))
{
}

SheetSolvers::OfLaw SheetSolvers::made(shell::Membrane membrane) const
{
  OfLaw result;
  if (exist())
    result.solver = std::make_unique<shell::MembraneSolver<2>>(membrane, held);
  result.membrane = std::move(membrane);
  return result;
}

const SheetSolvers::OfLaw &SheetSolvers::under(const Law of_reference) const
{
  if (homogenized_law(of_reference, corotational.membrane.stiffness.front().D) != Law::yarn)
    return corotational;
  if (!of_yarns)
  {
    shell::Membrane membrane = corotational.membrane;
    shell::take_yarn_law(membrane);
    of_yarns = std::make_unique<OfLaw>(made(std::move(membrane)));
  }
  return *of_yarns;
}

const shell::Membrane &SheetSolvers::membrane(const Law of_reference) const
{
  return under(of_reference).membrane;
}

const shell::MembraneSolver<2> &SheetSolvers::solver(const Law of_reference) const
{
  return *under(of_reference).solver;
}
} // namespace homespun::verification
