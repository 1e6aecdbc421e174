// SPDX-License-Identifier: MIT
#include "homogenization/bracket/airy_unknowns.h"

#include "meshes/plain/index.h"

#include <cmath>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// (value, d/dx, d/dy) of the stress functions of the unit mean stresses, one load per column:
/// y²/2 for 11, x²/2 for 22, −xy for 12.
Eigen::Matrix3d stress_functions_of_means(const Eigen::Vector2d &p)
{
  Eigen::Matrix3d q;
  q << 0.5 * p(1) * p(1), 0.5 * p(0) * p(0), -p(0) * p(1), //
    0., p(0), -p(1),                                       //
    p(1), 0., -p(0);
  return q;
}
} // namespace

/// Written out: GCC 12 with -O3 -march=native was seen, here alone, to leave the second component
/// of an inlined Vector2d(...).normalized() undivided.
Eigen::Vector2d edge_normal(const TorusEdge &edge)
{
  const double length = edge.vector.norm();
  return {edge.vector(1) / length, -edge.vector(0) / length};
}

AiryUnknowns::AiryUnknowns(const TorusMesh &mesh, const Holes holes,
                           const NormalDerivatives normal_derivatives)
    : mesh(mesh)
    , normal_derivatives(normal_derivatives)
{
  if (holes == Holes::empty)
    rims = rims_of(mesh);
  else
    rims = {std::vector<RimPoint>(at(mesh.n_vertices)), std::vector<RimPoint>(mesh.edges.size()),
            0};
  number_unknowns();
}

/// Close to a vertex P of the given mesh phi is stored as phi − phi(P), because next to a strong
/// singularity it varies by less than the round-off of phi itself. That starts at 1/256 of the
/// shortest edge at P: coarser meshes keep plain values. Triangles inside never see phi(P), which
/// their stress does not depend on; those across the border have it as one unknown more.
void AiryUnknowns::number_unknowns()
{
  constexpr double closeness = 1. / 256.;
  int n                      = 0;
  centre_of.assign(at(mesh.n_vertices), -1);
  first_unknown.assign(at(mesh.n_vertices), -1);
  for (int v = 0; v < mesh.n_vertices; ++v)
  {
    if (rims.of_vertex[at(v)].hole >= 0)
      continue;
    first_unknown[at(v)] = n;
    n += 3;
    const VertexOrigin &home = mesh.origins[at(v)];
    if (rims.of_vertex[at(home.vertex)].hole < 0 &&
        home.offset.norm() < closeness * mesh.reach[at(home.vertex)])
      centre_of[at(v)] = home.vertex;
  }
  unknown_of_edge.assign(mesh.edges.size(), -1);
  for (int e = 0; e < mesh.n_edges(); ++e)
    if (rims.of_edge[at(e)].hole < 0 && normal_derivatives == NormalDerivatives::quadratic)
      unknown_of_edge[at(e)] = n++;
  first_unknown_of_hole.resize(at(rims.n_holes));
  for (int &first : first_unknown_of_hole)
  {
    first = n;
    n += 3;
  }
  pinned =
    first_unknown_of_hole.empty() ? first_unknown[at(mesh.anchor)] : first_unknown_of_hole.front();
  number = n;
}

AiryDof AiryUnknowns::on_rim(const RimPoint &rim,
                             const Eigen::RowVector3d &of_value_and_gradient) const
{
  // phi = A + B.x − q(x), of which the row takes a combination of value and gradient.
  const int first         = first_unknown_of_hole[at(rim.hole)];
  const Eigen::Vector2d x = rim.position;
  AiryDof dof;
  dof.unknowns = {first, first + 1, first + 2};
  dof.factors  = {of_value_and_gradient(0),
                  of_value_and_gradient(0) * x(0) + of_value_and_gradient(1),
                  of_value_and_gradient(0) * x(1) + of_value_and_gradient(2)};
  dof.known    = -of_value_and_gradient * stress_functions_of_means(x);
  return dof;
}

AiryDof AiryUnknowns::value_at(const int vertex) const
{
  if (rims.of_vertex[at(vertex)].hole >= 0)
    return on_rim(rims.of_vertex[at(vertex)], Eigen::RowVector3d::Unit(0));
  AiryDof dof;
  dof.unknowns[0] = first_unknown[at(vertex)];
  dof.factors[0]  = 1.;
  return dof;
}

AiryDofs AiryUnknowns::of_triangle(const int t) const
{
  const TorusTriangle &triangle = mesh.triangles[at(t)];
  AiryDofs dofs;
  const auto centre    = [&](const int k) { return centre_of[at(triangle.vertices[at(k)])]; };
  const bool is_inside = centre(0) >= 0 && centre(0) == centre(1) && centre(0) == centre(2);
  for (int k = 0; k < 3; ++k)
  {
    const int v = triangle.vertices[at(k)], e = triangle.edges[at(k)];
    if (rims.of_vertex[at(v)].hole >= 0)
      for (int d = 0; d < 3; ++d)
        dofs[at(3 * k + d)] = on_rim(rims.of_vertex[at(v)], Eigen::RowVector3d::Unit(d));
    else
    {
      for (int d = 0; d < 3; ++d)
      {
        dofs[at(3 * k + d)].unknowns[0] = first_unknown[at(v)] + d;
        dofs[at(3 * k + d)].factors[0]  = 1.;
      }
      if (is_inside && centre(k) == v)
        dofs[at(3 * k)] = {};
      else if (!is_inside && centre(k) >= 0 && centre(k) != v)
      {
        dofs[at(3 * k)].unknowns[1] = first_unknown[at(centre(k))];
        dofs[at(3 * k)].factors[1]  = 1.;
      }
    }
    if (normal_derivatives == NormalDerivatives::linear)
      continue;
    if (rims.of_edge[at(e)].hole >= 0)
    {
      const Eigen::Vector2d normal = edge_normal(mesh.edges[at(e)]);
      dofs[at(9 + k)]              = on_rim(rims.of_edge[at(e)], {0., normal(0), normal(1)});
    }
    else
    {
      dofs[at(9 + k)].unknowns[0] = unknown_of_edge[at(e)];
      dofs[at(9 + k)].factors[0]  = 1.;
    }
  }
  for (AiryDof &dof : dofs)
    for (int &unknown : dof.unknowns)
      if (unknown == pinned)
        unknown = -1;
  return dofs;
}
} // namespace homespun::homogenization
