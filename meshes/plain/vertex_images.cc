// SPDX-License-Identifier: MIT
#include "meshes/plain/vertex_images.h"

#include "meshes/plain/index.h"

#include <numeric>

namespace homespun::meshes
{
ImageClasses match_images(const TriangleMesh &mesh, const std::vector<int> &some,
                          const Lattice &lattice)
{
  const ImageClasses found = match_images(Points(mesh.vertices(some, Eigen::all)), lattice);
  ImageClasses all;
  all.representative.resize(at(mesh.n_vertices()));
  std::iota(all.representative.begin(), all.representative.end(), 0);
  all.offset.setZero(mesh.n_vertices(), 2);
  all.size.assign(at(mesh.n_vertices()), 1);
  for (std::size_t k = 0; k < some.size(); ++k)
  {
    all.representative[at(some[k])] = some[at(found.representative[k])];
    all.offset.row(some[k])         = found.offset.row(static_cast<Eigen::Index>(k));
    all.size[at(some[k])]           = found.size[k];
  }
  return all;
}
} // namespace homespun::meshes
