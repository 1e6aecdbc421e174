// SPDX-License-Identifier: MIT
// Error budget (guides/how-studies-work.md): the distance of the up-sampled sheet from the resolved
// one, split into parts, each a field at the fine vertices and a difference of solutions.
//
// Solutions. M: the method (given coarse mesh H, cell and C^H from P1 on the given cell mesh h). T:
// the resolved reference, P1 on the same mesh h. T': the same by a second code (second_code.h). *:
// P2 on the mesh h. u_H, u: homogenized sheet on the coarse mesh, and on one refined so far that it
// counts as resolved. E, R: its strain U − I and rotation; <.>: their means over each coarse
// triangle, averaged to the coarse vertices, linear in between (what the method does). w(E) =
// −chi : E.
//
//  1 the order of the cell at edges, each at the strain and law itself (edge_parts.h); S0 = u + R
//    w(E) with chi anchored at the lattice, S4 the same with all terms of edges and chi of mean
//    zero:
//    slip        slip of clamped edges, and with it the constant of chi
//    selvedge    tension of free edges
//    bulk        the force of strain gradients
//    layer       modes that decay from the edges
//    rest        S4 − T', in linear theory, times strain: what is of higher order in the cell, and
//                corners between clamped and free edges. Against T', never against the reference
//                that is explained. Of a cell without terms of edges S4 is S0
//  2 geometric nonlinearity; û in equilibrium with the stress of the cell at finite strain, ŵ its
//    fluctuation (nonlinear_cell.h)
//    macro-law   S0 − [û + R^ w(Ê)]: small-strain stiffness in place of that at finite strain
//    modes       [û + R^ w(Ê)] − [û + R^ ŵ(Ê)]: small-strain chi in place of that at finite strain
//  3 coarse-mesh   [u_H + R_H w(<E_H>)] − [u + R w(<E>)]: solving and interpolating on the coarse
//                  mesh
//  5 blending      [R w(<E>)] − [R w(E)] at the resolved solution: averaging and blending of the
//                  strain
//  6 time-step     0: the loads are static
//  7 solver        [M − M with tight tolerances] − [T − T with a tight tolerance]
// The rotation lift needs no part: for a frame indifferent law it is exact in an infinite cloth.
// Their sum stands against M − T; what it leaves is `unexplained`. Beside the sum, because method
// and reference share the mesh of the cell and its discretization hits both:
//  4 cell          M − M with chi* and C^H*
//    reference     T* − T, at that strain and law
//  8 precision     [M in float] − M
//    resolution    [u + R w(E)] − the same with u on a mesh half as fine: three times what u lacks
//                  if u converges with order two, and as much as it lacks if corners leave it order
//                  one
//
// What the sum tests. In linear theory 1, 3 and 5 are links of one chain from M to T', whatever u
// is: there the sum says that Upsampler and CoarseModel do what the parts say of them, and
// that T is T', which shares with T the mesh, the stiffness of the phases and the load. At finite
// strain the same holds up to what `rest` does beyond linear theory, which is in no part. In an
// infinite cloth there is none: there the sum tests part 2 as well. That a link has its right name
// is said by its order: 2 in strain for part 2; 2 in H for part 3, which `resolution` is read off;
// for part 1 by the study of cells per sheet (converge), and by the term `edges`, which lacks
// what the four terms are without `rest`. `rest` is not measured at the strain itself: as [û + R^
// ŵ(Ê)] + S4 − S0 − T' it would take up whatever part 2 has wrong, and the sum would close for any
// part 2.
//
// The bar of `unexplained`, from means over the vertices. With f = T' − u, g = û + R^ ŵ(Ê) − u and
// c = S4 − S0, and a prime for the same per unit strain in linear theory, the chain leaves
// −(f − s f') + (g − s g') + (c − s c'), so that |unexplained| <= |f − s f'| + |g − s g'| +
// |c − s c'| (triangle inequality) + misfit |2| (what the table of part 2 is known to) + what the
// solvers leave. Linear law and infinite cloth: the last two alone.
#pragma once

#include "meshes/plain/cell_edges.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/method/sheet_reading.h"
#include "verification/strain/budget/edge_parts.h"

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// One cell homogenized in the ways that the budget compares.
struct BudgetCells
{
  meshes::HomogenizedCell given; ///< P1 on the given mesh, as the method uses it
  meshes::HomogenizedCell best;  ///< P2
  meshes::HomogenizedCell tight; ///< P1 with a tighter solver
  std::vector<Eigen::Matrix3d> stiffness_of_phase;
  std::optional<meshes::CellEdges> edges; ///< none: their terms stand in `rest`
};

/// The names of the parts by their numbers, then what stands beside them.
const std::vector<std::string> &budget_parts();

/// Whether a part stands in the sum, or beside it.
bool is_in_sum(const std::string &part);

/// Parts of the error at one strain, fields (n,2) at the fine vertices [m].
struct ErrorBudget
{
  std::map<std::string, meshes::Points> parts;
  meshes::Points total;               ///< M − T as measured
  double misfit_of_localization = 0.; ///< NonlinearLocalization::misfit()

  /// Whether all parts were measured, and not part 2 alone.
  bool is_whole() const
  {
    return parts.count("rest") != 0;
  }

  /// Of the parts that stand in the sum.
  meshes::Points sum() const;

  /// How large the mean of |total − sum| may be [m]; not a number where T' was not solved at that
  /// strain and law.
  double bar = std::numeric_limits<double>::quiet_NaN();
};

/// The solutions at one strain that others have computed.
struct SolvedLevel
{
  double strain = 0.;
  const shell::Positions<2> &coarse; ///< u_H
  const meshes::Points &upsampled;   ///< M, double precision
  const meshes::Points &reference;   ///< T
  /// T with a tight tolerance; null: the error and part 2 alone are asked for.
  const meshes::Points *tight_reference;
  const meshes::Points *p2_reference; ///< T*, or null where it was not solved
  const meshes::Points *second;       ///< T' at that strain and law, or null
};

/// The budget of one sheet under one load. Linear theory is solved once, what depends on strain per
/// level.
class LoadBudget
{
public:
  /// @param second T' of the law `linear` at strain `linear_strain` (n,2) [m]
  /// @param refinement of the coarse mesh that counts as resolved, quads into refinement²; even
  LoadBudget(const BudgetCells &cells, const meshes::Sheet &sheet, const Load &load,
             const meshes::Points &second, double linear_strain, int refinement);

  /// @throws NotConverged where a solution of a part cannot be found
  ErrorBudget measure(Law law, const SolvedLevel &level);

private:
  /// Homogenized sheets under a law.
  struct SheetsOfLaw
  {
    CoarseModel resolved, half_resolved;
    CoarseModel best, tight; ///< on the coarse mesh
  };
  const SheetsOfLaw &sheets(Law law);
  void measure_edges(const CoarseState &u, const meshes::Points &with_exact, Law law,
                     ErrorBudget &budget);
  void measure_nonlinearity(Law law, const shell::Positions<2> &u, const meshes::Points &with_exact,
                            ErrorBudget &budget) const;
  meshes::Points resolution(Law law, double strain, const meshes::Points &with_exact);
  double bar_of_sum(Law law, const SolvedLevel &level, const meshes::Points &homogenized,
                    const meshes::Points &with_exact, const ErrorBudget &budget) const;

  const BudgetCells &cells;
  const meshes::Sheet &sheet;
  const Load load;
  const std::array<Quads, 2> quads; ///< of the resolved sheet, and of that half as fine
  const SheetReading coarse, resolved, half_resolved;
  std::map<Law, std::unique_ptr<const SheetsOfLaw>> of_laws;
  std::optional<std::array<meshes::CellEdges, 4>> edges; ///< piece by piece
  meshes::Points rest;                                   ///< per unit strain [m]
  meshes::Points fluctuation, localization, with_terms;  ///< f', g', c' of the bar [m]
  std::optional<CoarseState> last, last_half;            ///< of the resolved sheets
};

/// 16 where the sheet is small, else what brings the refined mesh to about 160 quads per side, at
/// least 4; even.
int budget_refinement(const meshes::Sheet &sheet);
} // namespace homespun::verification
