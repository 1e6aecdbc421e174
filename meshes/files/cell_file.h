// SPDX-License-Identifier: MIT
// cell.h5: the homogenized cell on disk. HDF5, SI units, every dataset says its unit:
//   /vertices (n,2) [m]   /triangles (m,3)   /material (m)   /lattice (2,2) [m], rows a1, a2
//   /chi (n,2,3) [m], vertex, component, load; attribute `anchor`: the vertex where chi is zero
//   /C (3,3) [N/m]        /areal_density [kg/m^2]            attribute `provenance` of the file
//   attribute `format_version` of the file (format_version.h)
//   attribute `place_of_cut` of the file, where the cell is not cut from the cloth as it is drawn
// and what up-sampling takes beside chi, where it was made (cell_terms_file.h).
#pragma once

#include "meshes/plain/homogenized_cell.h"

#include <string>

namespace homespun::meshes
{
/// Writes a cell whole or not at all: to a temporary file beside it, which then takes its name.
/// @throws std::logic_error where read_cell() would refuse it: whoever made it is wrong
/// @throws BadInput where the file cannot be written
void write_cell(const HomogenizedCell &cell, const std::string &file);

/// Reads a cell and holds it against what every cell fulfils: matching shapes, a sound mesh, finite
/// values, a symmetric positive definite stiffness, chi zero at its anchor.
/// @throws BadInput naming the file and the dataset
HomogenizedCell read_cell(const std::string &file);
} // namespace homespun::meshes
