// SPDX-License-Identifier: MIT
// The unit cells of the axes, each made of the parameter that makes it hard, and what the program
// finds of them.
#pragma once

#include "homogenization/fem/homogenize.h"
#include "verification/stress/stress_case.h"

#include <Eigen/Core>

#include <string>

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

/// Stripes with an obtuse triangle: the middle of an edge inside the lower layer is lifted off the
/// edge by so many parts of its length.
UnitCell capped_stripes(int n, const Phase &lower, const Phase &upper, double height);

/// The moduli E of the phases become E_min (E / E_min)^p, with p such that the largest over the
/// smallest is `contrast`; so each grows with the contrast. Shear moduli keep their ratio to E.
/// @param cell that has_contrast()
UnitCell with_contrast(const UnitCell &cell, double contrast);

/// Whether two phases differ in Young's modulus.
bool has_contrast(const UnitCell &cell);

/// Homogenizes a cell on the calling rank alone, with the program's defaults but the order.
/// @throws NotConverged, BadInput
homogenization::Homogenization solved(const UnitCell &cell, unsigned int order = 1);

/// The limit of an energy of C^H whose discrete problem is known to the last digit.
/// @param is what the figure is
Limit limit_of(const UnitCell &cell, const std::string &is);
} // namespace homespun::verification
