// SPDX-License-Identifier: MIT
#include "meshes/garment/fine_panel.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace homespun::meshes
{
std::vector<std::array<int, 3>> fans_of(const FinePanel &panel,
                                        const std::vector<KeptTriangle> &kept)
{
  const CutMesh &cut = *panel.cut;
  std::vector<std::array<int, 3>> fans_of_corner(kept.size(), {0, 0, 0});
  std::map<int, std::vector<std::pair<std::size_t, std::size_t>>> around; // by vertex of `cut`
  for (std::size_t t = 0; t < kept.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const int v = panel.cut_vertex_of(kept[t].corners[k]);
          v >= 0 && !cut.vertices[at(v)].outline.empty())
        around[v].emplace_back(t, k);
  for (const auto &[v, corners] : around)
  {
    std::vector<std::size_t> fan(corners.size());
    std::iota(fan.begin(), fan.end(), 0u);
    // A handful of triangles: merge until nothing changes.
    for (bool changed = true; changed;)
    {
      changed = false;
      for (std::size_t p = 0; p < corners.size(); ++p)
        for (std::size_t q = 0; q < p; ++q)
        {
          if (fan[p] == fan[q])
            continue;
          const auto &[t, k] = corners[p];
          const auto &[s, l] = corners[q];
          // Around a vertex, neighbours share the corner after it in one and before it in the
          // other.
          for (const auto &[here, there] :
               {std::pair<int, int>{kept[t].corners[(k + 1) % 3], kept[s].corners[(l + 2) % 3]},
                std::pair<int, int>{kept[t].corners[(k + 2) % 3], kept[s].corners[(l + 1) % 3]}})
          {
            const int w = panel.cut_vertex_of(here);
            if (here == there && (w < 0 || cut.common_edges(v, w).empty()))
            {
              fan[p] = fan[q] = std::min(fan[p], fan[q]);
              changed         = true;
            }
          }
        }
    }
    std::map<std::size_t, int> number;
    for (std::size_t p = 0; p < corners.size(); ++p)
      fans_of_corner[corners[p].first][corners[p].second] =
        number.emplace(fan[p], static_cast<int>(number.size())).first->second;
  }
  return fans_of_corner;
}
} // namespace homespun::meshes
