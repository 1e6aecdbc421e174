// SPDX-License-Identifier: MIT
#include "verification/periodic_cell/cell_assembly.h"

namespace homespun::verification
{
CellAssembly::Sparse CellAssembly::vertex_tangent(const Eigen::Matrix2d &macro,
                                                  const meshes::Points &w) const
{
  const meshes::TriangleMesh &mesh = cell.mesh;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * static_cast<std::size_t>(mesh.n_triangles()));
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const auto &g                 = hats[static_cast<std::size_t>(t)];
    Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero();
    Eigen::Matrix2d F             = macro;
    for (int k = 0; k < 3; ++k)
    {
      F += w.row(mesh.triangles(t, k)).transpose() * g.row(k);
      B.block<2, 1>(0, 2 * k)     = g.row(k).transpose();
      B.block<2, 1>(2, 2 * k + 1) = g.row(k).transpose();
    }
    const Eigen::Matrix3d &c     = stiffness_of_phase[static_cast<std::size_t>(mesh.material(t))];
    const Eigen::Matrix4d second = areas(t) / cell.lattice.area() * response(law, c, F).tangent;
    const Eigen::Matrix<double, 6, 6> stiffness = B.transpose() * second * B;
    for (int k = 0; k < 6; ++k)
      for (int l = 0; l < 6; ++l)
        entries.emplace_back(2 * mesh.triangles(t, k / 2) + k % 2,
                             2 * mesh.triangles(t, l / 2) + l % 2, stiffness(k, l));
  }
  Sparse matrix(2 * mesh.n_vertices(), 2 * mesh.n_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}
} // namespace homespun::verification
