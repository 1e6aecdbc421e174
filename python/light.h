// SPDX-License-Identifier: MIT
// The parts of the module _light.
#pragma once

#include <pybind11/pybind11.h>

namespace homespun::python
{
/// The classes Cell, Bracket and BracketedCell.
void declare_cell(pybind11::module_ &module);

/// The class Garment and read_positions().
void declare_garment(pybind11::module_ &module);

/// The class Cloth.
void declare_cloth(pybind11::module_ &module);
} // namespace homespun::python
