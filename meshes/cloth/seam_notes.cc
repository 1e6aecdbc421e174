// SPDX-License-Identifier: MIT
#include "meshes/cloth/cloth_faults.h"
#include "meshes/cloth/seams.h"
#include "meshes/plain/fault_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace homespun::meshes
{
std::vector<std::string> seam_notes(const ClothMesh &cloth, const std::string &name)
{
  FaultList notes(name);
  const Panels panels = panels_of(cloth);
  for (const SeamEdge &seam : seam_edges(cloth))
  {
    std::array<double, 2> length{};
    for (std::size_t i = 0; i < 2; ++i)
    {
      const std::array<int, 2> ends = rest_ends(cloth, seam.sides[i]);
      length[i] = (cloth.rest.vertices.row(ends[1]) - cloth.rest.vertices.row(ends[0])).norm();
    }
    if (std::abs(length[0] - length[1]) <= 0.01 * std::max(length[0], length[1]))
      continue;
    const std::array<int, 2> ends = space_ends(cloth, seam.sides[0]);
    std::ostringstream text;
    text << "the seam edge between vertices " << ends[0] << " and " << ends[1] << " is "
         << length[0] << " m long on panel " << panels.of_triangle(seam.sides[0].triangle)
         << " and " << length[1] << " m on panel " << panels.of_triangle(seam.sides[1].triangle)
         << " at rest: the longer side will gather";
    notes.add("seam edges of unequal length", text.str());
  }
  return notes.take();
}
} // namespace homespun::meshes
