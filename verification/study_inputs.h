// SPDX-License-Identifier: MIT
// What the rows of a study depend on, stored beside them, so that rows of different inputs never
// stand in one table.
#pragma once

#include "homogenization/unit_cell.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace homespun::verification
{
/// A cell's name becomes a field of a table and a folder.
/// @throws BadInput where two cells share one, or one holds a comma, a quote or a line break
void check_names(const std::vector<homogenization::UnitCell> &cells);

/// Writes inputs.json into a folder of results: sizes of the sheets, and for each cell its
/// fingerprint.
/// @param resume true: what is there must be the same
/// @throws BadInput where a study is to be resumed with other inputs
void check_inputs(const std::vector<homogenization::UnitCell> &cells, int n_cells,
                  int n_cells_of_error_bar, const std::string &folder, bool resume);

/// Writes any description of inputs as inputs.json into a folder of results.
/// @param table whose presence makes a study one that can be resumed
/// @param what the inputs are, for the message
/// @throws BadInput where it is to be resumed with other inputs
void check_inputs_file(const std::string &folder, const nlohmann::ordered_json &inputs, bool resume,
                       const std::string &table,
                       const std::string &what = "cells, materials, meshes or sizes");

/// A hash of a cell's mesh and lattice, and of stiffness and mass per area of its phases.
std::string fingerprint(const homogenization::UnitCell &cell);

/// A hash of a text.
std::string fingerprint(const std::string &text);
} // namespace homespun::verification
