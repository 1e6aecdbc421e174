// SPDX-License-Identifier: MIT
// What a scene run is made of, known before any file is written: the scene with what the options
// put in its place, what cannot be asked for, and the description by which a run is recognised when
// it is resumed.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/cell_edges.h"
#include "verification/cell/assessed_cells.h"
#include "verification/drape/drape_options.h"
#include "verification/drape/drape_schedule.h"
#include "verification/drape/scene_cloth.h"
#include "verification/method/method.h"
#include "verification/record/json_files.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Whether a reference is solved by finite elements, else by the shell's own code.
bool is_dealii(const std::string &reference);

/// The law that the moving cloth of a cell has where none is asked for: that of the cell
/// (laws/default_law.h), where a stiffness C^H (3,3) [N/m] can have it.
Law law_of_cloth(const homogenization::UnitCell &cell, const Eigen::Matrix3d &stiffness);

/// What the methods ask of a cell: edges, and the second order of laws that move.
CellNeeds needs_of(const DrapeOptions &options, const Scene &scene);

/// The scene file with what the options replace.
/// @throws BadInput with one message per fault
Scene scene_of(const DrapeOptions &options);

/// @throws BadInput where a reference lacks a term or a place, or a static scene has a motion;
/// where
///   a method asks for a term that the scene does not list, or the other way round
void check_references(const DrapeOptions &options, const Scene &scene);

/// @param stiffness C^H of the cell
/// @throws BadInput where its coarse cloth cannot have a law
void check_variant(const Scene &scene, const homogenization::UnitCell &cell,
                   const Eigen::Matrix3d &stiffness, Law law);

/// @throws BadInput where the cloth cannot be made of a cell, a held vertex does not exist, or a
///   place holds nothing
void check_cloth(const DrapeOptions &options, const Scene &scene,
                 const std::vector<homogenization::UnitCell> &cells);

/// The rows of a matrix, for drape.json.
nlohmann::ordered_json rows_of(const Eigen::Matrix3d &m);

/// What is to be known of a scene that can be run: single points that are held, at which a membrane
/// yields without bound as the mesh becomes finer.
std::vector<std::string> scene_warnings(const Scene &scene);

/// All that the rows, frames and states of a run depend on, beside its cells.
nlohmann::ordered_json drape_inputs(const DrapeOptions &options, const Scene &scene,
                                    const DrapeSchedule &schedule);

/// What was not asked for, and what that leaves open, for drape.json.
nlohmann::ordered_json what_was_left_out(const DrapeOptions &options, const Scene &scene);
} // namespace homespun::verification
