// SPDX-License-Identifier: MIT
// The bracket of a cell as the program makes it: on the mesh as given, or adaptively to a width;
// its history and its verdicts.
#pragma once

#include "homogenization/bracket/bracket.h"
#include "homogenization/fem/homogenize.h"
#include "verification/record/verdict.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct BracketOptions
{
  unsigned order = 2, refine = 0; ///< as those of the cell problems
  std::optional<double>
    tolerance;                ///< relative width to reach by adaptivity; none: the given mesh alone
  unsigned max_dofs = 400000; ///< of the larger of the two problems
};

/// One mesh on the way to a bracket.
struct BracketStep
{
  unsigned triangles, dofs, stress_dofs;
  double width, seconds; ///< since the start
};

/// A bracket, or the reason why there is none.
struct CellBracket
{
  std::optional<homogenization::Bracket> bracket; ///< on the last mesh
  std::optional<Eigen::Matrix3d>
    on_given_mesh; ///< energies on the straight triangles as given [N/m]
  std::vector<homogenization::FieldProducts>
    products;               ///< of the strains that C is the energy of, phase by phase
  std::string remark;       ///< why there is none, or how adaptivity ended
  bool is_left_out = false; ///< the settings allow none on this mesh
  std::vector<BracketStep> history;
};

/// The mesh of a cell on the torus, as often refined as the cell problems; that of a drawing on its
/// curves.
homogenization::TorusMesh torus_of(const homogenization::UnitCell &cell, unsigned refine);

/// Why the settings allow no bracket on the mesh of the cell problems; empty where they do.
std::string too_large_text(const homogenization::UnitCell &cell, const BracketOptions &options);

/// Why adaptivity ended, as a sentence.
std::string text_of(homogenization::AdaptiveEnd ending, const BracketOptions &options);

/// Brackets C^H on this process alone: direct solvers need no other.
/// @param report is told of each step, one line
CellBracket bracket_of(const homogenization::UnitCell &cell, const BracketOptions &options,
                       const std::function<void(const std::string &)> &report);

/// C_lower <= C_upper, C inside, agreement of both solvers on the given mesh, and the width that
/// was asked for; none where a bracket was neither made nor asked for.
/// @param stiffness C^H of the cell problems on the given mesh [N/m]
/// @param round_off algebraic_limit() of the cell: solvers that differ by more than 1e-6 and less
///   than this are INCONCLUSIVE
std::vector<Verdict> checks_of(const CellBracket &bracket, const BracketOptions &options,
                               const Eigen::Matrix3d &stiffness, double round_off);

/// Whose C^H a bracket holds: `mesh`, of straight triangles, or `drawing`, where phases have curved
/// sides.
const char *name_of_subject(const homogenization::Bracket &bracket);

/// How far an entry C_ij of either side can be from that of C^H: with D = upper − lower, which is
/// not negative, |C_ij − C^H_ij| <= sqrt(D_ii D_jj) [N/m].
Eigen::Matrix3d bars_of(const homogenization::Bracket &bracket);
} // namespace homespun::verification
