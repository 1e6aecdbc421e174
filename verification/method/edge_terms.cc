// SPDX-License-Identifier: MIT
#include "verification/method/edge_terms.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>

namespace homespun::verification
{
using localization::EdgeKind;
using meshes::CellEdges;

namespace
{
localization::UpsamplerOptions options_of(const Law law)
{
  localization::UpsamplerOptions options;
  if (law == Law::linear)
  {
    options.strain = localization::Strain::linear;
    options.lift   = localization::Lift::identity;
  }
  return options;
}

/// A row of CoarseFrames::values().
template <int dim>
using FrameRow = Eigen::Matrix<double, 1, 3 + 2 * dim>;

template <int dim>
Eigen::Matrix<double, dim, 2> lift_of(const FrameRow<dim> &frame)
{
  return Eigen::Map<const Eigen::Matrix<double, dim, 2, Eigen::RowMajor>>(frame.data() + 3);
}

/// −integral M_abc d_b E_a E_c(v) on the vertices, the gradient that of the strains at them.
/// @param bulk M, entry (a,c) of bulk[b] [N]
/// @param of_vertices CoarseFrames::values() of the mesh, blended
/// @return (n,dim) [N]
template <int dim>
localization::Positions<dim>
bulk_forces(const meshes::TriangleMesh &mesh, const std::array<Eigen::Matrix3d, 2> &bulk,
            const Eigen::Matrix<double, Eigen::Dynamic, 3 + 2 * dim, Eigen::RowMajor> &of_vertices)
{
  localization::Positions<dim> forces = localization::Positions<dim>::Zero(mesh.n_vertices(), dim);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const meshes::TriangleGeometry of =
      meshes::triangle_geometry(meshes::sides_of_triangle<2>(mesh.triangles.row(t), mesh.vertices));
    const Eigen::Matrix<double, 2, 3> slopes = of.shape_gradients.transpose();
    Eigen::Matrix<double, 2, 3> gradient     = Eigen::Matrix<double, 2, 3>::Zero(); // d_b E_a
    FrameRow<dim> mean                       = FrameRow<dim>::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const FrameRow<dim> frame = of_vertices.row(mesh.triangles(t, k));
      gradient += slopes.col(k) * frame.template head<3>();
      mean += frame / 3.;
    }
    Eigen::RowVector3d stress = Eigen::RowVector3d::Zero(); // of E_c(v)
    for (int b = 0; b < 2; ++b)
      stress += gradient.row(b) * bulk[static_cast<std::size_t>(b)];
    Eigen::Matrix2d tensor;
    tensor << stress(0), stress(2), stress(2), stress(1);
    const Eigen::Matrix<double, dim, 2> nominal = of.area * lift_of<dim>(mean) * tensor;
    for (int k = 0; k < 3; ++k)
      forces.row(mesh.triangles(t, k)) -= (nominal * slopes.col(k)).transpose();
  }
  return forces;
}

/// The vertices of a coarse mesh on an edge of its sheet, from one end to the other.
std::vector<int> vertices_of(const Quads quads, const int side)
{
  const int axis  = meshes::axis_of_side(side);
  const int n     = axis == 0 ? quads.n2 : quads.n1;
  const int fixed = !meshes::is_far_side(side) ? 0 : axis == 0 ? quads.n1 : quads.n2;
  std::vector<int> vertices;
  for (int k = 0; k <= n; ++k)
    vertices.push_back(axis == 0 ? k * (quads.n1 + 1) + fixed : fixed * (quads.n1 + 1) + k);
  return vertices;
}
} // namespace

EdgeKinds edge_kinds(const Load &load)
{
  if (load.is_periodic())
    throw meshes::BadInput("terms of edges: load " + load.name +
                           " is one of an infinite cloth, which has no edges; expected strip-1, "
                           "strip-2 or shear-frame");
  EdgeKinds kinds = {};
  for (int side = 0; side < CellEdges::n_sides; ++side)
  {
    Eigen::RowVector2d middle(0.5, 0.5);
    middle(meshes::axis_of_side(side))    = meshes::is_far_side(side) ? 1. : 0.;
    kinds[static_cast<std::size_t>(side)] = load.holds(middle) ? EdgeKind::clamped : EdgeKind::free;
  }
  return kinds;
}

EdgeKinds edge_kinds(const Quads quads, const std::vector<int> &held)
{
  EdgeKinds kinds = {};
  for (int side = 0; side < CellEdges::n_sides; ++side)
  {
    const std::vector<int> vertices = vertices_of(quads, side);
    const auto is_held              = [&](const int vertex)
    { return std::find(held.begin(), held.end(), vertex) != held.end(); };
    kinds[static_cast<std::size_t>(side)] =
      std::all_of(vertices.begin(), vertices.end(), is_held)            ? EdgeKind::clamped
      : std::none_of(vertices.begin() + 1, vertices.end() - 1, is_held) ? EdgeKind::free
                                                                        : EdgeKind::none;
  }
  return kinds;
}

template <int dim>
EdgeTerms<dim>::EdgeTerms(const CellModel &of, const meshes::Sheet &sheet,
                          const CoarseSpace &of_cloth, const EdgeKinds &kinds, const Law law)
    : law(law)
    , cell(of.cell)
    , edges(*of.edges)
    , fitted(of.fitted)
    , sheet(sheet)
    , space(of_cloth)
    , frames(space.grid.mesh, options_of(law))
    , kinds(kinds)
{
  if constexpr (dim == 3)
    for_each(EdgeKind::free,
             [this](const int side, const meshes::CellEdge &edge) { add_cables(side, edge); });
}

template <int dim>
void EdgeTerms<dim>::add_cables(const int side, const meshes::CellEdge &edge)
{
  const Eigen::Vector2d along =
    sheet.lattice.vectors.row(1 - meshes::axis_of_side(side)).transpose();
  const double kappa = shell::selvedge_stiffness(edge.tension, cell.stiffness, along);
  const double most =
    shell::largest_push(cell.stiffness, along, cell.lattice.area() / along.norm());
  if (-kappa >= most)
    throw meshes::BadInput("selvedge: edge " + std::to_string(side) + " of the sheet pushes with " +
                           std::to_string(-kappa) + " N per strain; expected less than the " +
                           std::to_string(most) +
                           " N that the coarse triangles behind it bear: leave out the method, "
                           "or cut the cell at another place");
  const std::vector<int> vertices = vertices_of(space.nodes.quads, side);
  for (std::size_t k = 0; k + 1 < vertices.size() && kappa != 0.; ++k)
    segments.push_back({{vertices[k], vertices[k + 1]}, along.norm(), kappa});
}

/// Calls a function with each edge of a kind.
template <int dim>
template <typename Function>
void EdgeTerms<dim>::for_each(const EdgeKind kind, const Function &function) const
{
  for (int side = 0; side < CellEdges::n_sides; ++side)
    if (kinds[static_cast<std::size_t>(side)] == kind)
      function(side, edges.sides[static_cast<std::size_t>(side)]);
}

template <int dim>
typename EdgeTerms<dim>::Positions EdgeTerms<dim>::slip(const Positions &positions) const
{
  std::optional<meshes::FittedResponse> response;
  if (fitted != nullptr)
    response.emplace(*fitted);
  const Values &of_vertices = frames.values(space.on_grid<dim>(positions));
  Positions result          = Positions::Zero(positions.rows(), dim);
  for_each(EdgeKind::clamped,
           [&](const int side, const meshes::CellEdge &edge)
           {
             for (const int node : vertices_of(space.nodes.quads, side))
             {
               const FrameRow<dim> frame = of_vertices.row(space.grid_vertex(node));
               Eigen::Vector3d strain    = frame.template head<3>();
               if (response)
                 strain = response->at(strain).head<3>().transpose();
               result.row(node) = (lift_of<dim>(frame) * edge.slip * strain).transpose();
             }
           });
  return result;
}

template <int dim>
typename EdgeTerms<dim>::Positions EdgeTerms<dim>::forces(const Positions &positions) const
{
  const Values &of_vertices = frames.values(space.on_grid<dim>(positions));
  Positions of_grid         = bulk_forces<dim>(space.grid.mesh, edges.bulk, of_vertices);
  if constexpr (dim == 2)
    for_each(EdgeKind::free, [&](const int side, const meshes::CellEdge &edge)
             { add_tension(side, edge, of_vertices, of_grid); });
  return space.loads_of_nodes<dim>(of_grid);
}

/// −integral T_a E_a t . dv/ds ds of a free edge.
template <int dim>
void EdgeTerms<dim>::add_tension(const int side, const meshes::CellEdge &edge,
                                 const Values &of_vertices, Positions &forces) const
{
  const Eigen::Vector2d along =
    sheet.lattice.vectors.row(1 - meshes::axis_of_side(side)).transpose().normalized();
  const std::vector<int> vertices = vertices_of(space.grid.quads, side);
  for (std::size_t k = 0; k + 1 < vertices.size(); ++k)
  {
    const FrameRow<dim> frame =
      0.5 * (of_vertices.row(vertices[k]) + of_vertices.row(vertices[k + 1]));
    const Eigen::Matrix<double, 1, dim> pull =
      frame.template head<3>().dot(edge.tension.transpose()) *
      (lift_of<dim>(frame) * along).transpose();
    forces.row(vertices[k]) += pull;
    forces.row(vertices[k + 1]) -= pull;
  }
}

template <int dim>
bool EdgeTerms<dim>::has_bulk_forces() const
{
  const double size = cell.stiffness.norm() * std::sqrt(cell.lattice.area()); // [N]
  return std::max(edges.bulk[0].norm(), edges.bulk[1].norm()) > 1e-9 * size;
}

std::string sentence_of_edges(const EdgeKinds &kinds)
{
  std::array<std::string, 3> lists;
  for (int side = 0; side < CellEdges::n_sides; ++side)
  {
    std::string &list = lists[static_cast<std::size_t>(kinds[static_cast<std::size_t>(side)])];
    list += std::string(list.empty() ? "" : " and ") + "axis " +
            std::to_string(meshes::axis_of_side(side) + 1) +
            (meshes::is_far_side(side) ? ", far end" : ", near end");
  }
  const auto or_none = [](const std::string &list) { return list.empty() ? "none" : list; };
  return "terms of edges: clamped, with slip and modes: " + or_none(lists[1]) +
         "; free, with tension and modes: " + or_none(lists[2]) +
         "; held in part, without terms: " + or_none(lists[0]);
}

template class EdgeTerms<2>;
template class EdgeTerms<3>;
} // namespace homespun::verification
