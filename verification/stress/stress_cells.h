// SPDX-License-Identifier: MIT
// The unit cells of the axes: made ones, what makes a cell hard, other descriptions of the same
// cloth, and what the program finds of them.
#pragma once

#include "homogenization/fem/homogenize.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
using homogenization::Phase;
using homogenization::UnitCell;

/// Two layers of half the cell each, stacked along axis 2, on n x n x 2 triangles of a square of
/// 1 cm.
/// @param thin one more row of triangles above the interface has so many parts of the height of the
///   others; one: there is none
UnitCell stripe_cell(int n, const Phase &lower, const Phase &upper, double thin = 1.);

/// A square of a quarter of the area within the other phase.
UnitCell inclusion_cell(int n, const Phase &matrix, const Phase &inclusion);

/// The cells of the map where none is given: stripes and a square inclusion, contrast 10, whose
/// stiff phase has its axis at 30 and at 45 degrees.
std::vector<UnitCell> made_cells();

/// A cell with an obtuse triangle: a vertex more inside one of its triangles, so many parts of the
/// length of an edge above the middle of that.
UnitCell with_sliver(const UnitCell &cell, double height);

/// Other phases. @param is_stiffest whether no other has a larger E1
UnitCell with_phases(const UnitCell &cell,
                     const std::function<void(Phase &phase, bool is_stiffest)> &change);

/// Poisson's ratio over the largest that a phase can have, sqrt(E1/E2). An isotropic phase stays
/// isotropic.
void set_poisson(Phase &phase, double ratio);

/// The moduli E of the phases become E_min (E / E_min)^p, with p such that the largest over the
/// smallest is `contrast`; so each grows with the contrast. Shear moduli keep their ratio to E.
/// @param cell that has_contrast()
UnitCell with_contrast(const UnitCell &cell, double contrast);

/// Whether two phases differ in Young's modulus.
bool has_contrast(const UnitCell &cell);

/// n1 x n2 cells as one. @throws BadInput where the outline is no parallelogram
UnitCell repeated(const UnitCell &cell, int n1, int n2);

/// The cloth turned, mirrored or scaled in its plane: mesh, lattice and axes of the phases.
/// @param A rotation, reflection, or a multiple of either
UnitCell mapped(const UnitCell &cell, const Eigen::Matrix2d &A);

/// Factors of all lengths in the plane, of the thickness, of the moduli.
struct Units
{
  double length, thickness, modulus;
};

UnitCell in_units(const UnitCell &cell, const Units &units);

/// @throws BadInput with the faults of mesh and phases that end the reading of a cell file
void refuse_unsound(const UnitCell &cell);

/// Homogenizes a cell on the calling rank alone, with the program's defaults but the order.
/// @throws NotConverged; BadInput as refuse_unsound()
homogenization::Homogenization solved(const UnitCell &cell, unsigned int order = 1);
} // namespace homespun::verification
