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
    return meshes::yarn_axes(stiffness).are_there ? of_reference : Law::biot;
  case Law::biot:
  case Law::green:
    break;
  }
  return Law::biot;
}

namespace
{
/// What has the law of a sheet.
const shell::Membrane &law_of(const shell::Membrane &membrane)
{
  return membrane;
}

const shell::Membrane &law_of(const shell::SixNodeMembrane &membrane)
{
  return membrane.points;
}

void give_yarns(shell::Membrane &membrane)
{
  shell::take_yarn_law(membrane);
}

void give_yarns(shell::SixNodeMembrane &membrane)
{
  give_yarns(membrane.points);
}
} // namespace

template <typename Sheet>
SheetSolvers<Sheet>::SheetSolvers(Sheet membrane, std::vector<int> of_held)
    : held(std::move(of_held))
    , corotational(made(std::move(membrane)))
{
}

template <typename Sheet>
typename SheetSolvers<Sheet>::OfLaw SheetSolvers<Sheet>::made(Sheet membrane) const
{
  OfLaw result;
  if (exist())
    result.solver = std::make_unique<shell::MembraneSolver<2, Sheet>>(membrane, held);
  result.membrane = std::move(membrane);
  return result;
}

template <typename Sheet>
const typename SheetSolvers<Sheet>::OfLaw &SheetSolvers<Sheet>::under(const Law of_reference) const
{
  const Law law = homogenized_law(of_reference, law_of(corotational.membrane).stiffness.front().D);
  if (!is_of_yarns(law))
    return corotational;
  if (!of_yarns)
  {
    Sheet membrane = corotational.membrane;
    give_yarns(membrane);
    of_yarns = made(std::move(membrane));
  }
  return *of_yarns;
}

template <typename Sheet>
const Sheet &SheetSolvers<Sheet>::membrane(const Law of_reference) const
{
  return under(of_reference).membrane;
}

template <typename Sheet>
const shell::MembraneSolver<2, Sheet> &SheetSolvers<Sheet>::solver(const Law of_reference) const
{
  return *under(of_reference).solver;
}

template class SheetSolvers<shell::Membrane>;
template class SheetSolvers<shell::SixNodeMembrane>;
} // namespace homespun::verification
