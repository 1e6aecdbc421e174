// SPDX-License-Identifier: MIT
// The edges of a cell as the program makes them, or why it has none.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/cell_edges.h"

#include <optional>
#include <string>

namespace homespun::homogenization
{
struct PlateEdges;
}

namespace homespun::verification
{
template <typename Edges>
struct KnownBy
{
  std::optional<Edges> edges;
  std::string why_not; ///< a clause, where there are none
  double seconds = 0.;
};
using KnownEdges      = KnownBy<meshes::CellEdges>;
using KnownPlateEdges = KnownBy<homogenization::PlateEdges>;

/// Slip, tension, modes and bulk term of a cell, on the triangles as given; on one rank.
/// @param order 1 or 2, that of its chi
KnownEdges known_edges(const homogenization::UnitCell &cell, unsigned int order);

/// Those of the cell's plate.
KnownPlateEdges known_edges_of_plate(const homogenization::UnitCell &cell);

/// known_edges() for a file that carries them in case somebody asks; none, with an estimate, where
/// they would take longer than all else. Studies that need them make them whatever it takes.
KnownEdges affordable_edges(const homogenization::UnitCell &cell, unsigned int order);
} // namespace homespun::verification
