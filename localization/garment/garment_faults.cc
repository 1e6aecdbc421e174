// SPDX-License-Identifier: MIT
#include "localization/garment/garment_faults.h"

#include "localization/edge_modes.h"
#include "localization/upsampler_faults.h"
#include "meshes/cloth/cloth_faults.h"
#include "meshes/cloth/seams.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homespun::localization
{
std::vector<std::string> garment_faults(const meshes::HomogenizedCell &cell,
                                        const meshes::ClothMesh &coarse,
                                        const meshes::FineCloth &fine,
                                        const UpsamplerOptions &options)
{
  std::vector<std::string> faults = meshes::cloth_faults(coarse, "coarse cloth");
  if (!(options.seam_fade >= 0.) || !(options.seam_fade <= meshes::seam_reach))
  {
    std::ostringstream text;
    text << "up-sampling: the fluctuation fades over " << options.seam_fade
         << " cell sides at seams; expected 0 to " << meshes::seam_reach;
    faults.push_back(text.str());
  }
  for (const std::string &fault : mode_faults(options))
    faults.push_back(fault);
  for (const std::string &fault : edge_faults(cell, options))
    faults.push_back(fault);
  if ((options.strain == Strain::linear || options.lift == Lift::identity) &&
      std::any_of(fine.grains.begin(), fine.grains.end(),
                  [](const meshes::Grain &grain) { return grain.angle != 0.; }))
    faults.emplace_back(
      "up-sampling: a linear strain or no lift is asked for of a cloth whose cells "
      "are turned; expected Strain::biot and a lift, which know of the turn");
  check_lattice(cell, fine.lattice, "fine cloth", faults);
  const auto n        = static_cast<Eigen::Index>(fine.n_vertices());
  const bool has_size = fine.panel.size() == n && fine.cell_vertex.size() == n &&
                        fine.cell_triangle.size() == n && fine.cell_weights.rows() == n &&
                        fine.coarse_triangle.size() == n && fine.coarse_weights.rows() == n &&
                        fine.seam_distance.size() == n;
  if (!has_size || n == 0)
    faults.push_back("fine cloth: its arrays do not all have one entry for each of its " +
                     std::to_string(n) + " vertices; make it by meshes::fine_cloth()");
  if (!faults.empty())
    return faults;

  for (int v = 0; v < n && faults.size() < 3; ++v)
  {
    const int image = fine.cell_vertex(v), inside = fine.cell_triangle(v),
              triangle = fine.coarse_triangle(v), panel = fine.panel(v);
    const std::string name = "fine cloth: vertex " + std::to_string(v) + " ";
    if (image >= cell.mesh.n_vertices() || inside >= cell.mesh.n_triangles() ||
        (image < 0 && inside < 0))
      faults.push_back(name + "names vertex " + std::to_string(image) + " and triangle " +
                       std::to_string(inside) + " of the cell, which has " +
                       std::to_string(cell.mesh.n_vertices()) + " and " +
                       std::to_string(cell.mesh.n_triangles()) +
                       "; expected one of them: it was tiled from another cell");
    else if (triangle < 0 || triangle >= coarse.n_triangles() || panel < 0 ||
             panel >= static_cast<int>(fine.grains.size()))
      faults.push_back(name + "lies in triangle " + std::to_string(triangle) + " of panel " +
                       std::to_string(panel) + "; expected one of " +
                       std::to_string(coarse.n_triangles()) +
                       " triangles: it was made from another coarse cloth");
    else
    {
      Eigen::RowVector2d point = Eigen::RowVector2d::Zero();
      for (int k = 0; k < 3; ++k)
        point +=
          fine.coarse_weights(v, k) * coarse.rest.vertices.row(coarse.rest.triangles(triangle, k));
      const meshes::Grain &grain = fine.grains[static_cast<std::size_t>(panel)];
      if (image >= 0)
        check_image(cell, image,
                    (fine.rest.vertices.row(v) - grain.origin) * grain.rotation() +
                      cell.mesh.vertices.row(cell.anchor),
                    "fine cloth", v, faults);
      const double distance = (point - fine.rest.vertices.row(v)).norm();
      if (!(distance <= 1e-6 * std::sqrt(fine.lattice.area()) + 1e-14 * point.norm()))
      {
        std::ostringstream text;
        text << name << "lies " << distance << " m from its place in coarse triangle " << triangle
             << " at rest; expected none: it was made from another coarse cloth";
        faults.push_back(text.str());
      }
    }
  }
  return faults;
}
} // namespace homespun::localization
