// SPDX-License-Identifier: MIT
// What a strain study compares at one level: every method against the resolved sheet, vertex by
// vertex.
#pragma once

#include "homogenization/cell/quadratic_strain.h"
#include "homogenization/cell/unit_cell.h"
#include "verification/cell/cell_edges.h"
#include "verification/strain/budget/budget_study.h"
#include "verification/strain/compared_level.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// The level nearest to 1 %, at which methods are compared.
double compared_strain(const StrainStudyOptions &options);

/// The laws of the references under which a method takes the cell's second order.
std::vector<Law> laws_of_second_order(const StrainStudyOptions &options);

/// The level nearest to 10 %: it is pictured, and its run times are measured.
double pictured_strain(const StrainStudyOptions &options);

/// Whether a method with terms of edges is among the methods.
bool has_edges(const StrainStudyOptions &options);

/// Prepares the methods on a sheet.
/// @param homogenized, edges, sheet, load to be kept by the caller
MethodsOnSheet methods_on_sheet(const homogenization::UnitCell &cell,
                                const meshes::HomogenizedCell &homogenized, const KnownEdges &edges,
                                const meshes::Sheet &sheet, const Load &load);

/// What a reader has to know of a level of the reference. Ready sentences.
std::vector<std::string> notes_of(const ReferenceStep &fine, Stability stability);

/// Moves the coarse cloth to a level, up-samples it by every method, and writes the errors whose
/// row is not there, the forces, the times, the pictures if this is a level for them, and a note on
/// the anchor at the compared strain. First rank.
/// @return the coarse cloth, and the fine positions of `localized`
/// @throws NotConverged where the coarse cloth finds no equilibrium, or positions are not finite
UpsampledLevel compare_methods(const StrainStudyOptions &options, const StrainLevel &level,
                               const ResolvedLevel &resolved, MethodsOnSheet &methods,
                               StrainOutput &output);
} // namespace homespun::verification
