// SPDX-License-Identifier: MIT
#include "shell/terms/six_node_term.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/algebra/triangle_slots.h"
#include "shell/terms/membrane_term.h"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace homespun::shell
{
namespace
{
constexpr int n_nodes = 6, n_points = 3, n_pairs = n_nodes * (n_nodes + 1) / 2;

/// The points as the triangles of a cloth, none of which has a corner in common with another.
meshes::ClothMesh cloth_of_points(const Membrane &points)
{
  meshes::ClothMesh cloth;
  cloth.rest.vertices  = points.vertices;
  cloth.rest.triangles = points.triangles;
  cloth.rest.material  = Eigen::VectorXi::Zero(points.triangles.rows());
  cloth.triangles      = points.triangles;
  cloth.positions.setZero(points.vertices.rows(), 3);
  cloth.positions.leftCols<2>() = points.vertices;
  return cloth;
}

class SixNodeTerm final : public Term
{
public:
  SixNodeTerm(SixNodeMembrane &&given, std::unique_ptr<Term> term)
      : membrane(std::move(given))
      , of_points(std::move(term))
  {
    std::vector<std::array<int, 2>> sides;
    of_points->couple(sides);
    const auto n_corners = index(static_cast<int>(membrane.points.vertices.rows()));
    stiffness.emplace(sides, std::vector<bool>(n_corners, false));
    of_points->attach(*stiffness);
    for (const TriangleSlots &slots : places_of(membrane.points.triangles, *stiffness))
      slots_of_points.push_back({slots[3], slots[4], slots[5]});
  }

  std::string name() const override
  {
    return "six-node " + of_points->name();
  }

  void couple(std::vector<std::array<int, 2>> &pairs) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
      for (int a = 0; a < n_nodes; ++a)
        for (int b = a + 1; b < n_nodes; ++b)
          pairs.push_back({membrane.triangles(t, a), membrane.triangles(t, b)});
  }

  void attach(const BlockMatrix &matrix) override
  {
    places.resize(index(n_triangles()));
    for (int t = 0; t < n_triangles(); ++t)
      for (int a = 0, k = 0; a < n_nodes; ++a)
        for (int b = a; b < n_nodes; ++b, ++k)
          places[index(t)][index(k)] =
            matrix.slot(membrane.triangles(t, a), membrane.triangles(t, b));
  }

  void begin_step(const StepStart &start) override
  {
    of_points->begin_step({corners(start.positions), start.velocities, start.time, start.step});
  }

  double energy(const Vectors &positions) const override
  {
    return of_points->energy(corners(positions));
  }

  double stored_energy(const Vectors &positions) const override
  {
    return of_points->stored_energy(corners(positions));
  }

  void add_gradient(const Vectors &positions, Vectors &gradient) const override
  {
    Vectors at_corners = Vectors::Zero(membrane.points.vertices.rows(), 3);
    of_points->add_gradient(corners(positions), at_corners);
    add_to_nodes(at_corners, gradient);
  }

  void add_derivatives(const Vectors &positions, const Hessian kind, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    Vectors at_corners = Vectors::Zero(membrane.points.vertices.rows(), 3);
    stiffness->clear();
    of_points->add_derivatives(corners(positions), kind, at_corners, *stiffness);
    add_to_nodes(at_corners, gradient);
    std::array<Eigen::Matrix3d, n_pairs> blocks;
    for (int t = 0; t < n_triangles(); ++t)
    {
      for (Eigen::Matrix3d &block : blocks)
        block.setZero();
      for (int q = 0; q < n_points; ++q)
        add_point(t, q, blocks);
      for (std::size_t k = 0; k < blocks.size(); ++k)
        matrix.add(places[index(t)][k], blocks[k]);
    }
  }

  std::size_t bytes() const override
  {
    return of_points->bytes() + stiffness->bytes() +
           index(n_triangles()) * (sizeof(places[0]) + sizeof(membrane.corners[0]) +
                                   n_points * sizeof(slots_of_points[0]) + 13 * sizeof(int));
  }

private:
  int n_triangles() const
  {
    return static_cast<int>(membrane.triangles.rows());
  }

  Vectors corners(const Vectors &positions) const
  {
    return corners_of_points<3>(membrane, positions);
  }

  void add_to_nodes(const Vectors &of_corners, Vectors &of_nodes) const
  {
    for (int t = 0; t < n_triangles(); ++t)
    {
      const Eigen::Matrix<double, n_nodes, 3> here =
        membrane.corners[index(t)].transpose() * of_corners.middleRows<9>(9 * t);
      for (int k = 0; k < n_nodes; ++k)
        of_nodes.row(membrane.triangles(t, k)) += here.row(k);
    }
  }

  Eigen::Matrix3d block_at(const BlockMatrix::Slot &slot) const
  {
    const Eigen::Matrix3d &block = stiffness->blocks[index(slot.block)];
    return slot.transposed ? Eigen::Matrix3d(block.transpose()) : block;
  }

  /// The stiffness of a point, whose corners 1 and 2 move against corner 0 with weights of the
  /// nodes: moving all three alike costs nothing.
  void add_point(const int t, const int q, std::array<Eigen::Matrix3d, n_pairs> &blocks) const
  {
    const auto &slots              = slots_of_points[index(n_points * t + q)];
    const Eigen::Matrix3d of[2][2] = {{block_at(slots[0]), block_at(slots[1])},
                                      {block_at(slots[1]).transpose(), block_at(slots[2])}};
    const auto &rows               = membrane.corners[index(t)];
    Eigen::Matrix<double, 2, n_nodes> weights;
    weights.row(0) = rows.row(3 * q + 1) - rows.row(3 * q);
    weights.row(1) = rows.row(3 * q + 2) - rows.row(3 * q);
    for (int a = 0, k = 0; a < n_nodes; ++a)
    {
      const Eigen::Matrix3d first  = weights(0, a) * of[0][0] + weights(1, a) * of[1][0],
                            second = weights(0, a) * of[0][1] + weights(1, a) * of[1][1];
      for (int b = a; b < n_nodes; ++b, ++k)
        blocks[index(k)] += weights(0, b) * first + weights(1, b) * second;
    }
  }

  const SixNodeMembrane membrane;
  const std::unique_ptr<Term> of_points;
  mutable std::optional<BlockMatrix> stiffness; ///< of the corners of all points: work space
  /// Of the blocks (1,1) (1,2) (2,2) of each point there.
  std::vector<std::array<BlockMatrix::Slot, 3>> slots_of_points;
  std::vector<std::array<BlockMatrix::Slot, n_pairs>> places; ///< (m) of the pairs of nodes
};
} // namespace

std::unique_ptr<Term> six_node_term(const SixNodeMesh &mesh, const Eigen::Matrix3d &stiffness,
                                    const double viscosity,
                                    const std::vector<meshes::CubicForm> &cubic)
{
  return six_node_term(mesh, stiffness,
                       [&](const meshes::ClothMesh &points)
                       { return membrane_term(points, {stiffness}, viscosity, cubic); });
}

std::unique_ptr<Term>
six_node_term(const SixNodeMesh &mesh, const Eigen::Matrix3d &stiffness,
              const std::function<std::unique_ptr<Term>(const meshes::ClothMesh &)> &of_points)
{
  SixNodeMembrane membrane   = six_node_membrane(mesh, stiffness);
  std::unique_ptr<Term> term = of_points(cloth_of_points(membrane.points));
  return std::make_unique<SixNodeTerm>(std::move(membrane), std::move(term));
}

Eigen::VectorXd six_node_masses(const SixNodeMesh &mesh, const double areal_density)
{
  if (!(areal_density > 0.) || !std::isfinite(areal_density))
    throw meshes::BadInput("areal density: found " + std::to_string(areal_density) +
                           " kg/m^2; expected a positive number");
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(mesh.nodes.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
  {
    Eigen::Matrix2d sides;
    for (int k = 0; k < 2; ++k)
      sides.col(k) =
        (mesh.nodes.row(mesh.triangles(t, k + 1)) - mesh.nodes.row(mesh.triangles(t, 0)))
          .transpose();
    const double mass = 0.5 * sides.determinant() * areal_density;
    for (int k = 0; k < n_nodes; ++k)
      masses(mesh.triangles(t, k)) += (k < 3 ? 1. / 19. : 16. / 57.) * mass;
  }
  for (Eigen::Index v = 0; v < masses.size(); ++v)
    if (!(masses(v) > 0.))
      throw meshes::BadInput("node " + std::to_string(v) +
                             ": belongs to no triangle and has no mass; remove it");
  return masses;
}
} // namespace homespun::shell
