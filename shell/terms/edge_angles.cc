// SPDX-License-Identifier: MIT
#include "shell/terms/edge_angles.h"

#include "shell/algebra/index.h"
#include "shell/algebra/triangle_slots.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <limits>

namespace homespun::shell
{
namespace
{
/// A triangle in space. About its edge k, opposite to corner k, it turns by Σ_v w(k,v) n·dx_v, with
/// n the normal, m_k the normal of the edge in its plane, inwards, b_v the gradient of the linear
/// function that is 1 at corner v, and w(k,v) = m_k·b_v.
struct Frame
{
  Eigen::Vector3d normal;
  Eigen::Matrix3d inward, along; ///< columns m_k, and the directions of the edges
  Eigen::Matrix3d turn, slide;   ///< w(k,v), and b_v along edge k [1/m]
};

class EdgeAngles final : public Term
{
public:
  EdgeAngles(const meshes::ClothMesh &mesh, EdgePlates &&measured)
      : triangles(mesh.triangles)
      , plates(std::move(measured.plates))
      , edges(std::move(measured.edges))
      , n_nodes(measured.n_nodes)
      , padding(std::move(measured.padding))
  {
    compliance.compute(measured.compliance);
  }

  std::string name() const override
  {
    return "bending";
  }

  int take_nodes(const int first) override
  {
    first_node = first;
    return n_nodes;
  }

  void couple(std::vector<std::array<int, 2>> &pairs) const override
  {
    couple_corners(triangles, pairs);
    for (int t = 0; t < n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (has_unknown(t, k))
        {
          for (int v = 0; v < 3; ++v)
            pairs.push_back({triangles(t, v), node(t, k)});
          for (int l = 0; l < k; ++l)
            if (has_unknown(t, l) && node(t, l) != node(t, k))
              pairs.push_back({node(t, l), node(t, k)});
        }
  }

  void attach(const BlockMatrix &matrix) override
  {
    places = places_of(triangles, matrix);
    node_places.assign(index(n_triangles()), {});
    for (int t = 0; t < n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (has_unknown(t, k))
        {
          NodeSlots &own = node_places[index(t)];
          for (int v = 0; v < 3; ++v)
            own.of_corner[index(k)][index(v)] = matrix.slot(triangles(t, v), node(t, k));
          for (int l = 0; l < 3; ++l)
            if (has_unknown(t, l))
              own.of_edge[index(k)][index(l)] = matrix.slot(node(t, k), node(t, l));
        }
    padding_places.clear();
    for (const auto &[node, component] : padding)
      padding_places.emplace_back(matrix.slot(first_node + node, first_node + node), component);
  }

  double energy(const Vectors &x) const override
  {
    if (first_collapsed(x) >= 0)
      return std::numeric_limits<double>::infinity();
    const Eigen::VectorXd theta = angles_at_edges(edges, triangles, x);
    return theta.size() == 0 ? 0. : 0.5 * theta.dot(compliance.solve(theta));
  }

  std::string why_infinite(const Vectors &x) const override
  {
    const int t = first_collapsed(x);
    return t < 0 ? std::string() : "triangle " + std::to_string(t) + ", a line without a normal";
  }

  void add_gradient(const Vectors &x, Vectors &gradient) const override
  {
    const Eigen::VectorXd moments = moments_of(x);
    for (int t = 0; t < n_triangles(); ++t)
      if (has_normal(x, t))
        add_forces(t, frame(x, t), moments, gradient);
  }

  void add_derivatives(const Vectors &x, const Hessian kind, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    const Eigen::VectorXd moments = moments_of(x);
    for (int t = 0; t < n_triangles(); ++t)
    {
      if (has_normal(x, t))
      {
        const Frame own = frame(x, t);
        add_forces(t, own, moments, gradient);
        add_corners(t, own, moments, kind, matrix);
      }
      add_edges(t, matrix);
    }
    for (const auto &[slot, component] : padding_places)
      matrix.blocks[index(slot.block)](component, component) += 1.;
  }

  std::size_t bytes() const override
  {
    return index(triangles.size()) * sizeof(int) +
           plates.size() * (sizeof(EdgePlate) + sizeof(TriangleSlots) + sizeof(NodeSlots)) +
           edges.size() * sizeof(PlateEdge) +
           static_cast<std::size_t>(compliance.matrixL().nestedExpression().nonZeros()) *
             (sizeof(double) + sizeof(int));
  }

private:
  struct NodeSlots
  {
    std::array<std::array<BlockMatrix::Slot, 3>, 3> of_corner, of_edge;
  };

  int n_triangles() const
  {
    return static_cast<int>(triangles.rows());
  }
  bool has_unknown(const int t, const int k) const
  {
    return plates[index(t)].sign[index(k)] != 0.;
  }
  const PlateEdge &edge_of(const int t, const int k) const
  {
    return edges[index(plates[index(t)].edge[index(k)])];
  }
  int node(const int t, const int k) const
  {
    return first_node + edge_of(t, k).place.node;
  }

  Eigen::Vector3d side(const Vectors &x, const int t, const int k) const
  {
    return (x.row(triangles(t, (k + 2) % 3)) - x.row(triangles(t, (k + 1) % 3))).transpose();
  }

  bool has_normal(const Vectors &x, const int t) const
  {
    const Eigen::Vector3d a = side(x, t, 0), b = side(x, t, 1);
    return a.cross(b).norm() > 1e-12 * std::max(a.squaredNorm(), b.squaredNorm());
  }

  int first_collapsed(const Vectors &x) const
  {
    for (int t = 0; t < n_triangles(); ++t)
      if (!has_normal(x, t))
        return t;
    return -1;
  }

  Eigen::VectorXd moments_of(const Vectors &x) const
  {
    const Eigen::VectorXd theta = angles_at_edges(edges, triangles, x);
    return theta.size() == 0 ? theta : Eigen::VectorXd(compliance.solve(theta));
  }

  Frame frame(const Vectors &x, const int t) const
  {
    Frame own;
    Eigen::Matrix3d gradients; // columns b_v
    const Eigen::Vector3d twice_area = side(x, t, 0).cross(side(x, t, 1));
    own.normal                       = twice_area.normalized();
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d e = side(x, t, k), inward = own.normal.cross(e);
      gradients.col(k)  = inward / twice_area.norm();
      own.inward.col(k) = inward.normalized();
      own.along.col(k)  = e.normalized();
    }
    own.turn  = own.inward.transpose() * gradients;
    own.slide = own.along.transpose() * gradients;
    return own;
  }

  Eigen::Vector3d moments_at(const int t, const Eigen::VectorXd &moments) const
  {
    Eigen::Vector3d own = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      if (const int e = plates[index(t)].edge[index(k)]; e >= 0)
        own(k) = moments(e);
    return own;
  }

  void add_forces(const int t, const Frame &own, const Eigen::VectorXd &moments,
                  Vectors &gradient) const
  {
    const Eigen::Vector3d along_normal = own.turn.transpose() * moments_at(t, moments);
    for (int v = 0; v < 3; ++v)
      gradient.row(triangles(t, v)) += along_normal(v) * own.normal.transpose();
  }

  /// Blocks of the corners, and those that they have with the edges. A triangle's part of d²θ is
  ///   −(w_u w_v + ½ s_u s_v)(n m^T + m n^T) − w_u s_v n τ^T − w_v s_u τ n^T
  /// with s_v the component of b_v along the edge: what of it is not symmetric, the neighbour takes
  /// away.
  void add_corners(const int t, const Frame &own, const Eigen::VectorXd &moments,
                   const Hessian kind, BlockMatrix &matrix) const
  {
    const EdgePlate &plate   = plates[index(t)];
    const Eigen::Matrix3d Kw = plate.K * own.turn, wKw = own.turn.transpose() * Kw;
    const Eigen::Matrix3d nn = own.normal * own.normal.transpose();
    const Eigen::Vector3d r  = moments_at(t, moments);
    std::array<Eigen::Matrix3d, 3> nm, nt;
    if (kind == Hessian::exact)
      for (int k = 0; k < 3; ++k)
      {
        nm[index(k)] = r(k) * own.normal * own.inward.col(k).transpose();
        nm[index(k)] += nm[index(k)].transpose().eval();
        nt[index(k)] = r(k) * own.normal * own.along.col(k).transpose();
      }
    for (int v = 0, b = 0; v < 3; ++v)
      for (int u = v; u < 3; ++u, ++b)
      {
        Eigen::Matrix3d block = wKw(v, u) * nn;
        if (kind == Hessian::exact)
          for (int k = 0; k < 3; ++k)
            block -= (own.turn(k, u) * own.turn(k, v) + 0.5 * own.slide(k, u) * own.slide(k, v)) *
                       nm[index(k)] +
                     own.turn(k, u) * own.slide(k, v) * nt[index(k)] +
                     own.turn(k, v) * own.slide(k, u) * nt[index(k)].transpose();
        matrix.add(places[index(t)][index(b)], block);
      }
    for (int k = 0; k < 3; ++k)
      if (has_unknown(t, k))
        for (int v = 0; v < 3; ++v)
        {
          const BlockMatrix::Slot &slot = node_places[index(t)].of_corner[index(k)][index(v)];
          const int component           = edge_of(t, k).place.component;
          const Eigen::Vector3d column  = plate.sign[index(k)] * Kw(k, v) * own.normal;
          BlockMatrix::Block &stored    = matrix.blocks[index(slot.block)];
          if (slot.transposed)
            stored.row(component) += column.transpose();
          else
            stored.col(component) += column;
        }
  }

  void add_edges(const int t, BlockMatrix &matrix) const
  {
    const EdgePlate &plate = plates[index(t)];
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
      {
        if (!has_unknown(t, k) || !has_unknown(t, l))
          continue;
        const BlockMatrix::Slot &slot = node_places[index(t)].of_edge[index(k)][index(l)];
        const bool is_diagonal        = node(t, k) == node(t, l);
        if (slot.transposed && !is_diagonal)
          continue; // stored once, when k and l come the other way round
        matrix.blocks[index(slot.block)](edge_of(t, k).place.component,
                                         edge_of(t, l).place.component) +=
          plate.sign[index(k)] * plate.sign[index(l)] * plate.K(k, l);
      }
  }

  const meshes::Triangles triangles;
  const std::vector<EdgePlate> plates; ///< (m)
  const std::vector<PlateEdge> edges;
  const int n_nodes;
  const std::vector<EdgePlates::Place> padding;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> compliance; ///< C [1/(N m)]
  int first_node = 0;
  std::vector<TriangleSlots> places;
  std::vector<NodeSlots> node_places;
  std::vector<std::pair<BlockMatrix::Slot, int>> padding_places;
};
} // namespace

std::unique_ptr<Term> edge_angles_term(const meshes::ClothMesh &mesh,
                                       const std::vector<PlateStiffness> &stiffness,
                                       const std::vector<ClampedEdge> &clamps)
{
  return std::make_unique<EdgeAngles>(mesh, edge_plates(mesh, stiffness, clamps));
}
} // namespace homespun::shell
