// SPDX-License-Identifier: MIT
// A homogenized cell with its error bar, its checks and its bracket.
#pragma once

#include "homogenization/fem/homogenize.h"
#include "verification/cell/cell_bending.h"
#include "verification/cell/cell_bracket.h"
#include "verification/cell/cell_edges.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A homogenization and how far it may be from the limit of fine meshes.
struct AssessedCell
{
  homogenization::Homogenization result;
  homogenization::HomogenizationOptions options;
  /// factor_of_bars() |C − C of P2 on the once more refined mesh|, entry by entry [N/m]: the bar of
  /// a cell without a bracket, since C^H lies beyond that mesh; nothing where there is one, or
  /// where that mesh would exceed the limit of DoFs.
  std::optional<Eigen::Matrix3d> uncertainty;
  std::vector<Verdict> checks;
  /// Nothing where nobody asked for it. After adaptivity `result` holds the C^H, chi, DoFs and
  /// iterations of the last mesh.
  std::optional<CellBracket> bracket;
  std::optional<CellBending> bending; ///< nothing where nobody asked for it
  std::optional<KnownEdges> edges;    ///< nothing where nobody asked for them
  std::string folder;                 ///< of the files that it was read from; empty: it was solved
  /// Largest resident memory of each rank since the program began [bytes]; on the first rank alone.
  std::vector<double> peak_memory_of_rank;
  bool is_replaced = false; ///< C^H and chi are those of the last mesh of an adaptive bracket

  /// Whether C^H and chi are of the mesh as given, at whose vertices chi is written.
  bool is_of_given_mesh() const
  {
    return options.refine == 0 && !is_replaced;
  }
};

/// Whether the bracket is that of a drawing whose phases have curved sides.
bool is_of_drawing(const AssessedCell &assessed);

/// Mass per area of what the bracket is of, the drawing or the straight triangles [kg/m^2].
double areal_density(const homogenization::UnitCell &cell, const AssessedCell &assessed);

/// Homogenizes a cell and judges the result: Hill-Mandel gap, Voigt and Reuss as matrix
/// inequalities.
AssessedCell assess(const homogenization::UnitCell &cell,
                    const homogenization::HomogenizationOptions &options, MPI_Comm communicator);

/// Brackets the C^H of an assessed cell and adds the verdicts; an adaptive bracket replaces C^H and
/// chi by its better ones. To be called on one rank.
/// @param report is told of each step, one line
void add_bracket(const homogenization::UnitCell &cell, const BracketOptions &options,
                 const std::function<void(const std::string &)> &report, AssessedCell &assessed);

/// The error bar of a cell that has no bracket: the distance to P2 on the once more refined mesh,
/// where that has no more than `max_dofs` DoFs. A cell with a bracket has its bar, and is left as
/// it is. All ranks must call this; the first one knows of the bracket.
void add_estimate(const homogenization::UnitCell &cell, unsigned long max_dofs,
                  MPI_Comm communicator, AssessedCell &assessed);

/// Brackets the D^H of an assessed cell, rolls it up, and adds the verdicts. To be called on one
/// rank.
/// @param report is told of each step, one line
void add_bending(const homogenization::UnitCell &cell, const BracketOptions &options,
                 const std::function<void(const std::string &)> &report, AssessedCell &assessed);

/// Edges that belong to the chi that is written: none of a cell whose chi is of a finer mesh.
KnownEdges edges_beside(const homogenization::UnitCell &cell, const AssessedCell &assessed);

/// What the runtime needs of it, with its bending where that is known.
meshes::HomogenizedCell homogenized_cell(const homogenization::UnitCell &cell,
                                         const AssessedCell &assessed,
                                         const std::string &provenance);
} // namespace homespun::verification
