// SPDX-License-Identifier: MIT
// The error bar of the fine reference: how far P1 on the given mesh is from P2 on the refined one,
// at the same vertices, and how that carries over to the full sheet and to every strain.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/cell/discretization_distance.h"
#include "verification/law/laws.h"
#include "verification/reference/loads.h"
#include "verification/strain/strain_tables.h"

#include <mpi.h>

#include <functional>
#include <map>
#include <string>
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

/// The error bar of the P1 reference of one cell and load.
///
/// Measured on a small sheet with P1, P2 and refined P2: the linear law, which all laws approach at
/// small strain, and each nonlinear law at 5 % and at the largest strain of the study, where that
/// is more and all three find an equilibrium. In between, and beyond, the bar per strain runs
/// linearly in strain, never below half of the smallest that was measured. A law that is not
/// reached at 5 % keeps its small-strain bar; a bar that cannot be measured at all is not a number,
/// and empty in the results. To carry over to the full sheet it is multiplied by the ratio of
/// |P1 − P2|, linear law, at full size and on the small sheet, both measured; the mean by that of
/// the means, the largest by that of the largest. Of periodic loads the cell itself is measured and
/// nothing carries over.
///
/// The force along the load has a bar of its own by the same rule, relative to the force, and
/// carried over by the ratio of its own |P1 − P2|. A force is the derivative of an energy by the
/// motion of the clamp, so that its order is that of the energy: twice the exponent of the
/// strongest corner, and 4 where there is none.
class ReferenceUncertainty
{
public:
  static constexpr double small_strain = 1e-3, large_strain = 0.05;

  /// What of a study the bars are asked for.
  struct Scope
  {
    std::vector<Law> laws;
    int n_cells;           ///< of the full sheet per side
    int n_small;           ///< of the small sheet per side
    double largest_strain; ///< of the study
  };

  /// @param table receives what was measured, and gives back what it holds already; on the first
  ///   rank, elsewhere null
  ReferenceUncertainty(const homogenization::UnitCell &cell, const Load &load, const Scope &scope,
                       Table<UncertaintyRow> *table, MPI_Comm communicator,
                       const std::function<void(const std::string &)> &tell);

  /// Over the vertices of the sheet [m], and of the force [-].
  ReferenceBar at(Law law, double strain) const;

private:
  /// Distances, of the means and of the largest over the vertices [m], and of the force over that
  /// of P1 [-].
  struct Distances
  {
    DiscretizationDistance mean, max, force;
  };
  enum class Ladder
  {
    p1_p2,
    with_refined_p2
  };
  struct Measurement
  {
    int n_cells;
    Law law;
    std::vector<double> strains; ///< rising
    Ladder ladder;
  };

  std::vector<Distances> measure(const Measurement &what) const;
  std::vector<Distances> known_or_measured(const Measurement &what) const;
  bool look_up(const Measurement &what, double strain, Distances &known) const;
  void keep(const Measurement &what, double strain, const Distances &measured) const;
  ReferenceBar bar_of(const Distances &distances, double strain) const;

  const homogenization::UnitCell &cell;
  const Load load;
  Table<UncertaintyRow> *const table;
  const MPI_Comm communicator;
  const std::function<void(const std::string &)> tell;
  ReferenceBar carry_over = {1., 1., 1., 1.};
  double side             = 0.; ///< sqrt(|Y|) [m]
  double order            = 1.; ///< order_of_p2()
  double order_of_force   = 1.;
  /// Per strain and side, by the strain at which it was measured; the linear law's at 0.
  std::map<Law, std::map<double, ReferenceBar>> measured_bars;
};
} // namespace homespun::verification
