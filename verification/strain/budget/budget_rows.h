// SPDX-License-Identifier: MIT
// An error budget as numbers: norms of its parts over the sheet, its interior, its boundary layer
// and its corners. Plain arithmetic on fields, held against synthetic budgets.
//
//   mean, rms, max  of |p| over the vertices of a region
//   share           Σ p·t / |t|  over  Σ |t|, t the measured total at the vertex: the part of the
//                   total that p makes up; negative where it compensates others; the shares of a
//                   sum are the sum of the shares
//   unexplained     total − sum of the parts, vertex by vertex
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/strain/budget/budget_tables.h"
#include "verification/strain/budget/error_budget.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// all, interior, boundary, corner.
const std::vector<std::string> &budget_regions();

/// The region of each vertex as an index into budget_regions(), 1 to 3: `boundary` within two cells
/// of an edge (one where the sheet has fewer than eight cells on a side), `corner` within that
/// distance of two edges.
std::vector<int> regions_of(const meshes::Sheet &sheet, bool is_periodic);

/// The level nearest to a strain, by their ratio; there is one.
double strain_nearest_to(double wanted, const std::vector<double> &strains);

/// The levels of a study at which budgets are judged: those nearest to 1 % and to 10 %, within a
/// factor of 1.5.
std::vector<double> judged_strains(const std::vector<double> &strains);

/// Levels up to 2 %: beyond, the third order of part 2 shows.
bool is_small(double strain);

/// Levels off which its order is read: small ones from 1e-4 on. Three decide it.
bool decides_order(double strain);
bool decide_order(const std::vector<double> &strains);

/// What of a budget is measured at a level of a study.
enum class BudgetExtent
{
  none,
  order, ///< the error and part 2: of small levels, where they decide an order
  whole  ///< of levels that are judged; of all, where none is
};
BudgetExtent budget_extent(double strain, const std::vector<double> &strains);

/// Norms of one part in one region.
struct PartNorms
{
  double mean = 0., rms = 0., max = 0., share = 0.;
};

/// @param region 0: all vertices; NaN share where the total is zero
PartNorms norms_of(const meshes::Points &part, const meshes::Points &total,
                   const std::vector<int> &regions, int region);

/// Rows of budget.csv: every part that was measured, then of a whole budget `sum` and `unexplained`
/// = total − sum, then `total`, in every region that has vertices, and `unexplained-bar`, how large
/// the mean of `unexplained` may be.
/// @param side sqrt(|Y|) [m]
/// @param level names the rows: cell, load, strain, reference
std::vector<BudgetRow> budget_rows(const BudgetRow &level, const ErrorBudget &budget,
                                   const std::vector<int> &regions, double side);
} // namespace homespun::verification
