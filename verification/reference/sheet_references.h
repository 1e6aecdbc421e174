// SPDX-License-Identifier: MIT
// The resolved solutions of one sheet by discretization, for everything that asks for them.
#pragma once

#include "verification/reference/fine_reference.h"

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace homespun::verification
{
/// A sheet, and a reference of each discretization, made where it is first asked for: one serves
/// all loads and laws, which keeps its elements, and of one load its matrix and preconditioner.
class SheetReferences
{
public:
  SheetReferences(meshes::Sheet sheet, std::vector<Eigen::Matrix3d> stiffness_of_phase,
                  const MPI_Comm communicator)
      : sheet(std::move(sheet))
      , stiffness_of_phase(std::move(stiffness_of_phase))
      , communicator(communicator)
  {
  }
  SheetReferences(const SheetReferences &) = delete; // references look at their sheet

  /// Under the load and law of whoever started it last.
  FineReference &by(const unsigned int order, const unsigned int refine = 0)
  {
    std::unique_ptr<FineReference> &its = made[{order, refine}];
    if (!its)
      its = std::make_unique<FineReference>(sheet, stiffness_of_phase,
                                            ReferenceOptions{order, refine}, communicator);
    return *its;
  }

  const meshes::Sheet sheet;

private:
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;
  const MPI_Comm communicator;
  std::map<std::pair<unsigned int, unsigned int>, std::unique_ptr<FineReference>> made;
};
} // namespace homespun::verification
