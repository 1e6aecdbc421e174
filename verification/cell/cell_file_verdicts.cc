// SPDX-License-Identifier: MIT
#include "verification/cell/cell_file_verdicts.h"

#include "meshes/files/hdf5_reader.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/energy_order.h"
#include "verification/record/claim.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
using homogenization::UnitCell;

/// What the file holds, axes as its conventions name them.
struct StoredCell
{
  explicit StoredCell(const meshes::Hdf5Reader &file)
      : n_vertices(file.shape_of("/vertices", {meshes::Hdf5Reader::any, 2})[0])
      , n_triangles(file.shape_of("/triangles", {meshes::Hdf5Reader::any, 3})[0])
      , vertices(file.numbers("/vertices", {n_vertices, 2}))
      , chi(file.numbers("/chi", {n_vertices, 2, 3}))
      , lattice(file.numbers("/lattice", {2, 2}))
      , triangles(file.integers("/triangles", {n_triangles, 3}))
      , material(file.integers("/material", {n_triangles}))
      , C(Eigen::Map<const Eigen::Matrix3d>(file.numbers("/C", {3, 3}).data()))
      , anchor(file.integer_attribute("/chi", "anchor").value_or(-1))
  {
  }

  Eigen::RowVector2d vertex(const int v) const
  {
    return {vertices[static_cast<std::size_t>(2 * v)],
            vertices[static_cast<std::size_t>(2 * v + 1)]};
  }

  double mode(const int v, const int component, const int load) const
  {
    return chi[static_cast<std::size_t>((v * 2 + component) * 3 + load)];
  }

  const unsigned long long n_vertices, n_triangles;
  const std::vector<double> vertices, chi, lattice;
  const std::vector<int> triangles, material;
  const Eigen::Matrix3d C; // symmetric: no matter how it is stored
  const int anchor;
};

/// 1/|Y| integral (E − eps(chi)):c:(E − eps(chi)).
Eigen::Matrix3d energies_of(const StoredCell &stored, const UnitCell &cell)
{
  const std::vector<Eigen::Matrix3d> c = cell.stiffness_of_phase();
  Eigen::Matrix3d energy               = Eigen::Matrix3d::Zero();
  for (std::size_t t = 0; t < stored.n_triangles; ++t)
  {
    const int *const corner = &stored.triangles[3 * t];
    // x = X (1, y1, y2) at the corners gives the gradient of what is linear between them; from the
    // first corner, so that it does not matter where the cell was drawn.
    Eigen::Matrix3d ones_and_places;
    for (int k = 0; k < 3; ++k)
      ones_and_places.row(k) << 1., stored.vertex(corner[k]) - stored.vertex(corner[0]);
    const Eigen::Matrix3d coefficients = ones_and_places.inverse();
    Eigen::Matrix3d strain             = Eigen::Matrix3d::Identity();
    for (int load = 0; load < 3; ++load)
      for (int k = 0; k < 3; ++k)
      {
        const double d1 = coefficients(1, k), d2 = coefficients(2, k),
                     chi1 = stored.mode(corner[k], 0, load), chi2 = stored.mode(corner[k], 1, load);
        strain.col(load) -= Eigen::Vector3d(d1 * chi1, d2 * chi2, d2 * chi1 + d1 * chi2);
      }
    energy += 0.5 * std::abs(ones_and_places.determinant()) * strain.transpose() *
              c[static_cast<std::size_t>(stored.material[t])] * strain;
  }
  return energy /
         std::abs(stored.lattice[0] * stored.lattice[3] - stored.lattice[1] * stored.lattice[2]);
}

/// Vertices that lie a lattice vector away from a vertex, and itself.
int n_images_of(const int v, const StoredCell &stored)
{
  Eigen::Matrix2d rows;
  rows << stored.lattice[0], stored.lattice[1], stored.lattice[2], stored.lattice[3];
  const Eigen::Matrix2d to_steps = rows.inverse();
  int n                          = 0;
  for (int u = 0; u < static_cast<int>(stored.n_vertices); ++u)
  {
    const Eigen::RowVector2d steps = (stored.vertex(u) - stored.vertex(v)) * to_steps;
    n += std::max(std::abs(steps(0) - std::round(steps(0))),
                  std::abs(steps(1) - std::round(steps(1)))) < 1e-6;
  }
  return n;
}

/// The vertices that lie lowest, farthest left, and so on: among them are the corners of a cell.
std::vector<int> outermost(const StoredCell &stored)
{
  std::vector<int> all;
  for (const Eigen::Vector2d &towards :
       {Eigen::Vector2d(1., 0.3), Eigen::Vector2d(-1., 0.3), Eigen::Vector2d(0.3, 1.),
        Eigen::Vector2d(0.3, -1.), Eigen::Vector2d(1., -0.3), Eigen::Vector2d(-1., -0.3)})
  {
    int farthest = 0;
    for (int v = 1; v < static_cast<int>(stored.n_vertices); ++v)
      if (stored.vertex(v).dot(towards) > stored.vertex(farthest).dot(towards))
        farthest = v;
    all.push_back(farthest);
  }
  return all;
}
} // namespace

std::vector<Verdict> cell_file_verdicts(const std::string &file, const UnitCell &cell)
{
  const StoredCell stored(meshes::Hdf5Reader(file, "a homogenized cell"));
  const auto n_triangles  = static_cast<double>(stored.n_triangles);
  const double difference = energy_difference(energies_of(stored, cell), stored.C),
               limit      = algebraic_limit(cell, std::sqrt(0.5 * n_triangles)) +
                       n_triangles * std::numeric_limits<double>::epsilon();
  int most = 0;
  for (const int v : outermost(stored))
    most = std::max(most, n_images_of(v, stored));
  const int of_anchor = stored.anchor >= 0 ? n_images_of(stored.anchor, stored) : 0;
  return {at_most("cell-file-energy", {{"cell", cell.name}}, difference, limit),
          judged("cell-file-anchor", {{"cell", cell.name}, {"most", most}},
                 of_anchor >= most ? Outcome::pass : Outcome::fail,
                 static_cast<double>(of_anchor))};
}
} // namespace homespun::verification
