// SPDX-License-Identifier: MIT
// The parts of the module _light.
#pragma once

#include "meshes/plain/homogenized_cell.h"

#include <pybind11/pybind11.h>

namespace homespun::python
{
/// Of a fine mesh, unless somebody asks for more: some 5 GB.
constexpr long most_triangles = 10'000'000;

/// Refuses so many cells where their fine mesh would fill the memory, or could not be numbered.
/// @throws BadInput with both numbers
void check_size(const meshes::HomogenizedCell &cell, double n_cells, long max_triangles);

/// The classes Cell, Bracket and BracketedCell.
void declare_cell(pybind11::module_ &module);

/// The class Garment and read_positions().
void declare_garment(pybind11::module_ &module);

/// The class Cloth.
void declare_cloth(pybind11::module_ &module);
} // namespace homespun::python
