// SPDX-License-Identifier: MIT
// The error bar of the fine reference: how far P1 on the given mesh is from P2 on the refined one,
// at the same vertices, and how that carries over to the full sheet and to every strain. That of an
// error by the same rule: what method and reference share of it is no fault of either.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/cell/discretization_distance.h"
#include "verification/law/laws.h"
#include "verification/reference/loads.h"
#include "verification/reference/sheet_references.h"
#include "verification/strain/cell_ladder.h"
#include "verification/strain/strain_tables.h"

#include <mpi.h>

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace homespun::verification
{
/// What is known of the distance of a P1 reference from the limit of fine meshes, in one unit.
struct ReferenceBar
{
  double mean       = 0.; ///< error bar on the mean over the vertices
  double max        = 0.; ///< error bar at the worst vertex
  double to_refined = 0.; ///< |P1 − refined P2|, mean over the vertices
  double force      = 0.; ///< error bar on the force along the load, over that force [-]

  /// Another unit of length; that of the force has none.
  ReferenceBar operator*(double factor) const;
};

/// What is known of a method's mean error over the vertices.
struct ErrorBar
{
  double mean   = std::numeric_limits<double>::quiet_NaN(); ///< in the unit of the error
  double safety = std::numeric_limits<double>::quiet_NaN(); ///< F, the largest that it rests on
};

/// Of discretizations of which one was not reached, or not asked for.
constexpr double unknown_length                   = std::numeric_limits<double>::quiet_NaN();
constexpr DiscretizationDistance unknown_distance = {unknown_length, unknown_length, unknown_length,
                                                     false};

/// The methods whose errors get a bar, and what it is measured with.
struct MethodsOfCell
{
  std::vector<std::string> names             = {};
  std::function<const CellLadder &()> ladder = {}; ///< asked by all ranks at once; none: no bars
  const std::map<Law, meshes::FittedModes> *fitted = nullptr; ///< first rank
};

/// The error bar of the P1 reference of one cell and load, and those of the methods' errors.
///
/// Measured on a small sheet with P1, P2 and refined P2: the linear law, which all laws approach at
/// small strain, and each nonlinear law at 5 % and at the largest strain of the study, where that
/// is more and all three find an equilibrium; at 1 % where they find none at 5 %. In between, and
/// beyond, the bar per strain runs linearly in strain, never below half of the smallest that was
/// measured. A law that is not reached at 1 % either keeps its small-strain bar; a bar that cannot
/// be measured at all is not a number, and empty in the results. To carry over to the full sheet it
/// is multiplied by the ratio of |P1 − P2|, linear law, at full size and on the small sheet, both
/// measured; the mean by that of the means, the largest by that of the largest. By what a bar
/// exceeds that of linear theory it falls on no larger sheet: linear theory may err at edges alone.
/// Of periodic loads the cell itself is measured and nothing carries over.
///
/// The force along the load has a bar of its own by the same rule, relative to the force, and
/// carried over by the ratio of its own |P1 − P2|. A force is the derivative of an energy by the
/// motion of the clamp, so that its order is that of the energy: twice the exponent of the
/// strongest corner, and 4 where there is none.
///
/// The error of a method is delta = x_method − x_reference at the vertices, the cell solved, and
/// the reference, by the same discretization, the coarse elements unchanged. With delta of P1, P2
/// and refined P2 in place of positions the rule gives a bar of the mean error: by the triangle
/// inequality the mean of |delta| is no farther from that of refined P2 than the mean of
/// |delta − delta of refined P2|. Fitted modes stay those of P1.
class ReferenceUncertainty
{
public:
  static constexpr double small_strain = 1e-3, middle_strain = 0.01, large_strain = 0.05;

  /// What of a study the bars are asked for.
  struct Scope
  {
    std::vector<Law> laws;
    int n_cells;           ///< of the full sheet per side
    int n_small;           ///< of the small sheet per side
    double largest_strain; ///< of the study
    MethodsOfCell methods = {};
    SheetReferences *full = nullptr; ///< of that sheet; null: made for this
  };

  /// @param table receives what was measured, and gives back what it holds already; on the first
  ///   rank, elsewhere null
  ReferenceUncertainty(const homogenization::UnitCell &cell, const Load &load, const Scope &scope,
                       Table<UncertaintyRow> *table, MPI_Comm communicator,
                       const std::function<void(const std::string &)> &tell);

  /// Over the vertices of the sheet [m], and of the force [-].
  ReferenceBar at(Law law, double strain) const;

  /// Of the mean error of each method whose bar is known [m]; first rank.
  std::map<std::string, ErrorBar> of_errors(Law law, double strain) const;

private:
  /// Distances, of the means and of the largest over the vertices [m]; of the force by how much it
  /// falls, over that of P1 [-].
  struct Distances
  {
    DiscretizationDistance mean = unknown_distance, max = mean, force = mean;
    std::map<std::string, DiscretizationDistance> errors = {}; ///< of methods [m]; first rank
  };
  enum class Ladder
  {
    p1_p2,
    with_refined_p2
  };
  struct Measurement
  {
    SheetReferences &of;
    Law law;
    std::vector<double> strains; ///< rising
    Ladder ladder;
  };

  std::vector<Distances> measure(const Measurement &what) const;
  std::vector<Distances> known_or_measured(const Measurement &what) const;
  void add_errors(const Measurement &what,
                  const std::vector<std::vector<meshes::Points>> &references,
                  std::vector<Distances> &distances) const;
  bool look_up(const Measurement &what, double strain, Distances &known) const;
  bool look_up_errors(const Measurement &what, double strain, Distances &known) const;
  const UncertaintyRow *stored(const Measurement &what, double strain,
                               const std::string &method) const;
  void keep(const Measurement &what, double strain, const Distances &measured) const;
  ReferenceBar bar_of(const Distances &distances, double strain) const;
  void keep_bars(Law law, double strain, double measured_at, const Distances &distances);

  const homogenization::UnitCell &cell;
  const Load load;
  Table<UncertaintyRow> *const table;
  const MPI_Comm communicator;
  const std::function<void(const std::string &)> tell;
  const MethodsOfCell methods;
  ReferenceBar carry_over = {1., 1., 1., 1.};
  double side             = 0.; ///< sqrt(|Y|) [m]
  double order            = 1.; ///< order_of_p2()
  double order_of_force   = 1.;
  /// Per strain and side, by the strain at which it was measured; the linear law's at 0.
  std::map<Law, std::map<double, ReferenceBar>> measured_bars;
  std::map<std::pair<Law, std::string>, std::map<double, ErrorBar>> error_bars;
  std::map<std::string, double> carry_over_of_errors;
};
} // namespace homespun::verification
