// SPDX-License-Identifier: MIT
// What the inputs of a cell are worth: how C^H and D^H change with the constants of each phase, and
// the bars that follow from how well those are known. A bracket knows nothing of that: yarn moduli
// are known to a fifth, brackets are narrower by orders of magnitude.
#pragma once

#include "homogenization/cell/material_constants.h"
#include "verification/cell/assessed_cell.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// Derivatives by one constant of one group of the mesh, with the shape of everything fixed.
struct Sensitivity
{
  std::string group; ///< phase; phases that differ by the angles of the mesh are one
  homogenization::MaterialConstant constant;
  double value;         ///< in its unit; of the angle: that of the group's first phase
  Eigen::Matrix3d of_C; ///< [N/m per unit]
  Eigen::Matrix3d of_D; ///< [N m per unit]; zero where there is no D
};

/// dC_ab = 1/|Y| integral eps_a . dc . eps_b of the strains that C is the energy of, dD_ab = 1/|Y|
/// integral kappa_a . dD . kappa_b of the curvatures that D is the energy of: exact derivatives of
/// the C and D that are written, on their mesh. D of a drawing counts what its curves leave
/// uncertain with the phase that it was carved from.
/// @return empty where there is no bracket, whose fields these are
std::vector<Sensitivity> sensitivities(const homogenization::UnitCell &cell,
                                       const AssessedCell &assessed);

/// Whether every phase is made of constants: one of layers has none.
bool has_scaling_checks(const homogenization::UnitCell &cell);

/// C^H and D^H are of degree 1 in all moduli together, and of degree 1 and 3 in all thicknesses
/// together: with Euler's theorem
///   sum over moduli of p dC/dp = C,   sum of t dC/dt = C,   sum of p dD/dp = D,   sum of t dD/dt =
///   3 D,
/// sums over all phases, of the derivatives above. A phase bends with t^2/12 times its plane
/// stress stiffness in them, whatever D was made with.
/// D^H of a drawing is held to the width of its bracket, by which its curves leave it open.
/// @return a claim for each stiffness that has a bracket; none without has_scaling_checks()
std::vector<Verdict> scaling_checks(const homogenization::UnitCell &cell,
                                    const AssessedCell &assessed);

/// The derivatives of the phases' own stiffness, which sensitivities rest on, held against
/// differences.
/// @param cell that has_scaling_checks()
Verdict constants_check(const homogenization::UnitCell &cell);

/// One constant that lies within value +- range.
struct UncertainInput
{
  std::string group;
  homogenization::MaterialConstant constant;
  double range; ///< in its unit, positive
};

/// Reads `soft.E=20%,hard.thickness=1e-5`: parts of the value, or its unit [Pa, 1, m, deg].
/// @throws BadInput naming the cell file, and what was expected: unknown groups, constants that the
///   group does not have, numbers that are none, parts of a constant that is zero, the same twice
std::vector<UncertainInput> uncertain_inputs(const homogenization::UnitCell &cell,
                                             const std::string &text);

/// The largest change of each entry, to first order, while every input stays in its range: sum of
/// |dC_ij/dp| range.
struct InputBars
{
  Eigen::Matrix3d of_C, of_D; ///< [N/m], [N m]
};
InputBars input_bars(const std::vector<Sensitivity> &all,
                     const std::vector<UncertainInput> &inputs);
} // namespace homespun::verification
