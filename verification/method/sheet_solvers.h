// SPDX-License-Identifier: MIT
// The law of a homogenized sheet beside a reference, and the solvers of such a sheet.
#pragma once

#include "shell/membrane/six_node_membrane.h"
#include "shell/solver/equilibrium.h"
#include "verification/reference/laws.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace homespun::verification
{
/// The law of a homogenized sheet, coarse cloth or resolved, against a reference: `linear` and
/// `yarn` have their like, but for a stiffness without axes, which has none of yarns; all others
/// the corotational law, `biot`, which they approach as strain squared.
/// @param stiffness C^H (3,3) [N/m]
Law homogenized_law(Law of_reference, const Eigen::Matrix3d &stiffness);

/// A sheet with one stiffness under the laws it may have. The solver of yarns is made where it is
/// first asked for.
/// @tparam Sheet shell::Membrane or shell::SixNodeMembrane
template <typename Sheet = shell::Membrane>
class SheetSolvers
{
public:
  /// @param corotational the sheet, which may have a cubic energy
  /// @param held vertices; none: its motion is prescribed everywhere, and there is no solver
  SheetSolvers(Sheet corotational, std::vector<int> held);

  /// Whether vertices are held.
  bool exist() const
  {
    return !held.empty();
  }

  /// The sheet under the homogenized law; under `linear` its small-strain form is meant.
  /// @param of_reference law
  const Sheet &membrane(Law of_reference) const;

  /// Where they exist().
  const shell::MembraneSolver<2, Sheet> &solver(Law of_reference) const;

private:
  struct OfLaw
  {
    Sheet membrane;
    std::unique_ptr<shell::MembraneSolver<2, Sheet>> solver; ///< none where nothing is held
  };
  OfLaw made(Sheet membrane) const;
  const OfLaw &under(Law of_reference) const;

  std::vector<int> held;
  OfLaw corotational;
  mutable std::optional<OfLaw> of_yarns;
};
} // namespace homespun::verification
