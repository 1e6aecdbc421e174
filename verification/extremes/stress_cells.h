// SPDX-License-Identifier: MIT
// The unit cells that stress cases torment, what is done to them, and what theory says of their
// C^H: the closed form of a laminate, the turned tensor, and a factorized cell problem beside the
// iterative one.
#pragma once

#include "homogenization/cell/laminate.h"
#include "homogenization/cell/unit_cell.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/energy_order.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
using homogenization::laminate_stiffness;
using homogenization::Phase;
using homogenization::UnitCell;

/// Where the grid lines of a cell stand, from 0 to 1 in parts of its side.
using GridLines = std::vector<double>;

/// n equal steps.
GridLines equal_lines(int n);

/// A square cell of 1 cm with two triangles per rectangle of the grid; the phase is chosen by the
/// middle of the rectangle, in parts of the side.
UnitCell grid_cell(const GridLines &x, const GridLines &y, const std::vector<Phase> &phases,
                   const std::function<int(double x, double y)> &phase_at);

/// Two layers of half the cell each, stacked along axis 2.
UnitCell stripe_cell(int n, const Phase &lower, const Phase &upper);

/// A square of a quarter of the area within the other phase.
UnitCell inclusion_cell(int n, const Phase &matrix, const Phase &inclusion);

/// Two rectangles that touch neither each other nor their images.
UnitCell islands_cell(int n, const Phase &matrix, const Phase &islands);

/// The cell without the triangles of a phase.
UnitCell without_phase(const UnitCell &cell, int phase);

/// Stripes with an obtuse triangle: the middle of an edge inside the lower layer is lifted off the
/// edge by so many parts of its length.
UnitCell capped_stripes(int n, const Phase &lower, const Phase &upper, double height);

/// Whether shifted() would cut a hole: the triangles that touch it move apart. Such a cell is
/// refused.
/// @param origin in lattice vectors
bool cuts_a_hole(const UnitCell &cell, const Eigen::RowVector2d &origin);

/// Another cut of the same cloth: each triangle is replaced by that image whose middle lies in the
/// parallelogram of the lattice at `origin` (parts of the lattice vectors). The outline follows the
/// edges of triangles and need not be straight.
UnitCell shifted(const UnitCell &cell, const Eigen::RowVector2d &origin);

/// n1 x n2 cells as one. @throws BadInput where the outline is no parallelogram
UnitCell repeated(const UnitCell &cell, int n1, int n2);

/// The cloth turned counter-clockwise by an angle [deg]: mesh, lattice and axes of the phases.
UnitCell turned(const UnitCell &cell, double angle);

/// The cloth seen from behind, x to −x.
UnitCell mirrored(const UnitCell &cell);

/// Other units: all lengths in the plane, the thickness, and the moduli times a factor each.
UnitCell in_units(const UnitCell &cell, double length, double thickness, double modulus);

/// The moduli E of the phases become E_min (E / E_min)^p, with p such that the largest over the
/// smallest is `contrast`; so each grows with the contrast. Shear moduli keep their ratio to E.
/// @throws BadInput where all phases have the same modulus
UnitCell with_contrast(const UnitCell &cell, double contrast);

/// Whether two phases differ in Young's modulus.
bool has_contrast(const UnitCell &cell);

/// What a cell file must fulfil, of a cell made in memory.
/// @throws BadInput with the faults of mesh, phases and periodicity
void refuse_unsound(const UnitCell &cell);

/// The tensor C_ijkl = Q_ip Q_jq Q_kr Q_ls C_pqrs, index by index.
/// @param Q turns or mirrors @return Voigt order 11, 22, 12 with engineering shear
Eigen::Matrix3d moved_tensor(const Eigen::Matrix3d &C, const Eigen::Matrix2d &Q);

/// C^H of linear elements (paper Eqs. 2-4, energy form) by a sparse LDL^T factorization of the
/// torus: no tolerance, no preconditioner, and nothing shared with homogenize() but the mesh and
/// the law of the phases.
Eigen::Matrix3d factorized_stiffness(const UnitCell &cell);
} // namespace homespun::verification
