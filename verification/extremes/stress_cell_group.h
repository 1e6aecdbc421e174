// SPDX-License-Identifier: MIT
// What the stress cases of unit cells share: the phases of built-in cells, what a C^H is held
// against, and a group of cases.
#pragma once

#include "verification/extremes/stress_case.h"
#include "verification/extremes/stress_cells.h"

#include <string>
#include <utility>
#include <vector>

namespace homespun::verification
{
constexpr int rows_of_built_in = 16; ///< rectangles per side of the built-in cells

inline const char *const to_closed_form =
  "largest relative energy difference to the closed form [-]";
inline const char *const to_factorized =
  "largest relative energy difference to a factorized solve; or violation of Voigt or Reuss [-]";
inline const char *const to_original =
  "largest relative energy difference to the moved C^H of the cell as it was [-]";

/// E = 1 MPa, half a millimetre thick.
Phase soft_phase(double nu = 0.3);

Phase stiff_phase(double contrast, double nu = 0.3);

/// Ten thousand times as stiff along as across.
/// @param angle of its axis [deg]
Phase yarn_phase(double angle);

/// A limit and where it comes from.
struct Limit
{
  double value = 0.;
  std::string derivation;
};

/// algebraic_limit() of a cell with as many rows as a square of as many equal triangles.
Limit limit_of(const UnitCell &cell);

/// C^H of the iterative solver against that of a factorized one, and against Voigt and Reuss.
StressAnswer against_factorized(const UnitCell &cell);

/// C^H of layers stacked along axis 2, half of the cell each, against the closed form.
StressAnswer against_laminate(const UnitCell &cell, unsigned int order);

/// C^H of a cell over a factor against that of another, turned or mirrored.
StressAnswer against(const UnitCell &cell, const UnitCell &original, const Eigen::Matrix2d &Q,
                     double factor = 1.);

/// Rotation by an angle [deg].
Eigen::Matrix2d turn(double angle);

/// Cases of homogenization, which look twice.
class CellGroup
{
public:
  CellGroup(std::string name, std::vector<StressCase> &cases)
      : group(std::move(name), cases)
  {
  }

  template <typename Run>
  void finite(const std::string &what, const std::string &expected, const Limit &limit,
              const std::string &figure_is, const Run &run, const int most_repeats = 2)
  {
    StressCase &one  = group.finite(what, "finite; " + expected, {limit.value, figure_is},
                                    [run](unsigned int) -> StressAnswer { return run(); });
    one.most_repeats = most_repeats;
    one.derivation   = limit.derivation;
  }

  void refused(const std::string &what, const std::string &names, const UnitCell &cell);

private:
  CaseGroup group;
};

/// Cells that are shifted, repeated, turned, mirrored or given in other units are the same cloth.
std::vector<StressCase> symmetry_cases(const std::vector<UnitCell> &cells);
std::vector<StressCase> unit_cases(const std::vector<UnitCell> &cells);
} // namespace homespun::verification
