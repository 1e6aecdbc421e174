// SPDX-License-Identifier: MIT
#include "verification/periodic_cell/cell_assembly.h"

#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <utility>

namespace homespun::verification
{
CellAssembly::CellAssembly(meshes::HomogenizedCell of_cell,
                           std::vector<Eigen::Matrix3d> stiffness_of_phase, const Law law)
    : cell(std::move(of_cell))
    , stiffness_of_phase(std::move(stiffness_of_phase))
    , law(law)
    , unknown(static_cast<std::size_t>(cell.mesh.n_vertices()), -1)
    , areas(meshes::signed_areas(cell.mesh))
{
  const meshes::ImageClasses classes = meshes::match_images(cell.mesh.vertices, cell.lattice);
  const auto of                      = [&](const int v) { return static_cast<std::size_t>(v); };
  const int anchor                   = classes.representative[of(cell.anchor)];
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    if (const int master = classes.representative[of(v)]; master != anchor)
    {
      if (master == v)
      {
        unknown[of(v)] = n_unknowns;
        n_unknowns += 2;
      }
      else
        unknown[of(v)] = unknown[of(master)]; // the lowest index comes first
    }
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    hats.push_back(meshes::triangle_geometry(
                     meshes::sides_of_triangle<2>(cell.mesh.triangles.row(t), cell.mesh.vertices))
                     .shape_gradients);
  }
}

meshes::Points CellAssembly::spread(const Eigen::VectorXd &unknowns) const
{
  meshes::Points w = meshes::Points::Zero(cell.mesh.n_vertices(), 2);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    if (const int first = unknown[static_cast<std::size_t>(v)]; first >= 0)
      w.row(v) = unknowns.segment<2>(first).transpose();
  return w;
}

CellAssembly::Sums CellAssembly::sums(const Eigen::Matrix2d &macro, const meshes::Points &w,
                                      const Tangent tangent) const
{
  Sums sum;
  sum.residual.setZero(n_unknowns);
  const bool with_tangent = tangent != Tangent::none;
  if (with_tangent)
    sum.coupling.setZero(n_unknowns, 4);
  std::vector<Eigen::Triplet<double>> entries;
  double squared_size = 0., squared_round_off = 0.;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const auto &g = hats[static_cast<std::size_t>(t)];
    // B maps the fluctuations of the corners to the entries F11, F12, F21, F22.
    Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero();
    Eigen::Matrix2d F             = macro;
    double size_of_terms          = macro.norm(); // of the sum that F is
    for (int k = 0; k < 3; ++k)
    {
      F += w.row(cell.mesh.triangles(t, k)).transpose() * g.row(k);
      size_of_terms += w.row(cell.mesh.triangles(t, k)).norm() * g.row(k).norm();
      B.block<2, 1>(0, 2 * k)     = g.row(k).transpose();
      B.block<2, 1>(2, 2 * k + 1) = g.row(k).transpose();
    }
    const Eigen::Matrix3d &c = stiffness_of_phase[static_cast<std::size_t>(cell.mesh.material(t))];
    const Response local     = response(law, c, F);
    const double part        = areas(t) / cell.lattice.area();
    const double of_stress =
      part * std::numeric_limits<double>::epsilon() * c.cwiseAbs().maxCoeff() * size_of_terms;
    squared_round_off += of_stress * of_stress * g.squaredNorm();
    sum.stress_round_off += of_stress;
    // As in the resolved reference: green would reward a triangle that is turned over.
    sum.energy += law == Law::green && F.determinant() <= 0.
                    ? std::numeric_limits<double>::infinity()
                    : part * local.energy;
    sum.energy_round_off +=
      part * local.stress.norm() * std::numeric_limits<double>::epsilon() * size_of_terms;
    sum.force += part * local.stress;
    sum.stress_size += part * local.stress.norm();
    const Eigen::Matrix<double, 6, 1> force = part * B.transpose() * local.stress;
    squared_size += force.squaredNorm();
    Eigen::Matrix<double, 6, 4> coupling;
    Eigen::Matrix<double, 6, 6> stiffness;
    if (with_tangent)
    {
      const Eigen::Matrix4d second =
        part * (tangent == Tangent::projected ? positive_part(local.tangent) : local.tangent);
      coupling  = B.transpose() * second;
      stiffness = coupling * B;
      sum.macro_tangent += second;
    }
    for (int k = 0; k < 3; ++k)
    {
      const int row = unknown[static_cast<std::size_t>(cell.mesh.triangles(t, k))];
      if (row < 0)
        continue;
      sum.residual.segment<2>(row) += force.segment<2>(2 * k);
      if (!with_tangent)
        continue;
      sum.coupling.middleRows<2>(row) += coupling.middleRows<2>(2 * k);
      for (int l = 0; l < 3; ++l)
        if (const int column = unknown[static_cast<std::size_t>(cell.mesh.triangles(t, l))];
            column >= 0)
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              entries.emplace_back(row + i, column + j, stiffness(2 * k + i, 2 * l + j));
    }
  }
  sum.force_size = std::sqrt(squared_size);
  sum.round_off  = std::sqrt(squared_round_off);
  if (with_tangent)
  {
    sum.matrix.resize(n_unknowns, n_unknowns);
    sum.matrix.setFromTriplets(entries.begin(), entries.end());
  }
  return sum;
}

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
