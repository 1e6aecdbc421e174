// SPDX-License-Identifier: MIT
#include "homogenization/lint/facets.h"

#include "homogenization/cell/chi_strains.h"
#include "homogenization/cell/torus_mesh.h"
#include "homogenization/lint/cell_lint.h"
#include "meshes/plain/cross.h"
#include "meshes/plain/index.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homespun::homogenization
{
using meshes::at;
using meshes::cross;

namespace
{
constexpr double smallest_turn = 0.05 * M_PI / 180., largest_turn = 31. * M_PI / 180.;
constexpr double largest_ratio = 1.5;
constexpr std::size_t fewest   = 3;

/// The triangles on both sides of an edge, seen from tail to head; −1 for none.
struct Sides
{
  int left = -1, right = -1;
};

/// The outlines of all groups of phases on the torus.
class Outlines
{
public:
  explicit Outlines(const UnitCell &cell)
      : mesh(glued(cell.mesh, cell.lattice, cell.curved_sides))
      , sides(mesh.edges.size())
      , edges_of(at(mesh.n_vertices))
  {
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
      {
        const TorusTriangle &triangle                   = mesh.triangles[at(t)];
        Sides &its                                      = sides[at(triangle.edges[k])];
        (triangle.signs[k] > 0. ? its.left : its.right) = t;
      }
    const std::vector<int> group_of_phase = cell.group_of_phase();
    const auto group                      = [&](const int t)
    { return t < 0 ? -1 : group_of_phase[at(mesh.triangles[at(t)].material)]; };
    for (int e = 0; e < mesh.n_edges(); ++e)
    {
      groups.push_back({group(sides[at(e)].left), group(sides[at(e)].right)});
      if (groups.back()[0] != groups.back()[1])
        for (const int end : {mesh.edges[at(e)].tail, mesh.edges[at(e)].head})
          edges_of[at(end)].push_back(e);
    }
  }

  std::vector<Facet> facets() const
  {
    std::vector<Facet> found;
    for (int e = 0; e < mesh.n_edges(); ++e)
    {
      const TorusEdge &edge = mesh.edges[at(e)];
      if (groups[at(e)][0] == groups[at(e)][1] || !edge.bulge.isZero(0.))
        continue;
      // Walking backwards the outline turns the other way.
      const Bend head    = bend(e, edge.head, edge.vector);
      Bend tail          = bend(e, edge.tail, -edge.vector);
      tail.turn          = -tail.turn;
      const double least = std::min(std::abs(tail.turn), std::abs(head.turn)),
                   most  = std::max(std::abs(tail.turn), std::abs(head.turn));
      if (tail.turn * head.turn <= 0. || least < smallest_turn || most > largest_turn ||
          most > largest_ratio * least)
        continue;
      const Sides &its    = sides[at(e)];
      const bool left     = head.turn > 0.; // where the centre lies
      const double length = edge.vector.norm();
      found.push_back({left ? its.left : its.right, left ? its.right : its.left, edge.vector, least,
                       0.5 * (tail.curvature + head.curvature) * std::pow(length, 3) / 12.});
    }
    return found.size() < fewest ? std::vector<Facet>{} : found;
  }

private:
  struct Bend
  {
    double turn = 0., curvature = 0.;
  };

  /// How the outline goes on at a vertex that is reached along edge e; none where several outlines
  /// meet.
  Bend bend(const int e, const int vertex, const Eigen::Vector2d &arriving) const
  {
    const std::vector<int> &here = edges_of[at(vertex)];
    if (here.size() != 2 || here[0] == here[1])
      return {};
    const int next                = here[0] == e ? here[1] : here[0];
    const TorusEdge &edge         = mesh.edges[at(next)];
    const bool leaves             = edge.tail == vertex;
    const Eigen::Vector2d leaving = leaves ? edge.vector : Eigen::Vector2d(-edge.vector);
    if (!edge.bulge.isZero(0.))
      return {};
    Bend result;
    result.turn      = std::atan2(cross(arriving, leaving), arriving.dot(leaving));
    result.curvature = 2. * std::abs(std::sin(result.turn)) / (arriving + leaving).norm();
    return result;
  }

  const TorusMesh mesh;
  std::vector<Sides> sides;
  std::vector<std::array<int, 2>> groups; ///< left and right of each edge; −1 in holes
  std::vector<std::vector<int>> edges_of; ///< of outlines, at each vertex
};

/// Strains in the frame of an edge, (along, across, shear), from those in the frame of the cell.
Eigen::Matrix3d frame_of(const Eigen::Vector2d &vector)
{
  const Eigen::Vector2d t = vector.normalized(), n(-t(1), t(0));
  Eigen::Matrix3d M;
  M << t(0) * t(0), t(1) * t(1), t(0) * t(1), n(0) * n(0), n(1) * n(1), n(0) * n(1),
    2. * t(0) * n(0), 2. * t(1) * n(1), t(0) * n(1) + t(1) * n(0);
  return M;
}

} // namespace

std::vector<Facet> facets_of(const UnitCell &cell)
{
  return Outlines(cell).facets();
}

std::optional<GeometryEstimate> geometry_estimate(const UnitCell &cell, const meshes::Chi &chi)
{
  const std::vector<Facet> facets = facets_of(cell);
  if (facets.empty())
    return std::nullopt;
  const std::vector<Eigen::Matrix3d> stiffness = cell.stiffness_of_phase();
  GeometryEstimate estimate{static_cast<int>(facets.size()), 0., Eigen::Matrix3d::Zero()};
  for (const Facet &facet : facets)
  {
    const Eigen::Matrix3d M = frame_of(facet.vector), back = M.inverse();
    struct Mixed // stiffness where stretch and traction are given
    {
      double k;
      Eigen::Vector2d q;
      Eigen::Matrix2d f;
    };
    const auto stiffness_in_frame = [&](const int t) -> Eigen::Matrix3d
    { return back.transpose() * stiffness[at(cell.mesh.material(t))] * back; };
    const auto mixed_of = [&](const int t) -> Mixed
    {
      const Eigen::Matrix3d c = stiffness_in_frame(t);
      const Eigen::Matrix2d f = c.bottomRightCorner<2, 2>().inverse();
      const Eigen::Vector2d q = f * c.bottomLeftCorner<2, 1>();
      return {c(0, 0) - c.topRightCorner<1, 2>().dot(q), q, f};
    };
    Eigen::RowVector3d stretch           = Eigen::RowVector3d::Zero();
    Eigen::Matrix<double, 2, 3> traction = Eigen::Matrix<double, 2, 3>::Zero();
    double stiff = 0., soft = 0.;
    for (const int t : {facet.inside, facet.outside})
      if (t >= 0)
      {
        const Eigen::Matrix3d strain = M * strains_in(cell.mesh, chi, t);
        const Mixed its              = mixed_of(t);
        stretch += its.k * strain.row(0);
        traction += its.f.trace() * (stiffness_in_frame(t) * strain).bottomRows<2>();
        stiff += its.k;
        soft += its.f.trace();
      }
    stretch /= stiff;
    traction /= soft;
    if (facet.inside < 0 || facet.outside < 0) // the rim of a hole
      traction.setZero();
    const auto psi = [&](const int t) -> Eigen::Matrix3d
    {
      if (t < 0)
        return Eigen::Matrix3d::Zero();
      const Mixed its             = mixed_of(t);
      const Eigen::Matrix3d mixed = stretch.transpose() * (its.q.transpose() * traction);
      return its.k * stretch.transpose() * stretch + mixed + mixed.transpose() -
             traction.transpose() * its.f * traction;
    };
    estimate.area += facet.area / cell.lattice.area();
    estimate.change += facet.area / cell.lattice.area() * (psi(facet.inside) - psi(facet.outside));
  }
  return estimate;
}

std::vector<Finding> lint_facets(const UnitCell &cell, const double metres_per_unit)
{
  struct Outline
  {
    int n = 0, triangle = -1;
    double least = largest_turn, most = 0., area = 0.;
  };
  // By the phase whose arc it would be; a hole is told by what is around it.
  const std::vector<int> phase_of_group = cell.phase_of_group(), group = cell.group_of_phase();
  std::vector<Outline> outlines(phase_of_group.size());
  for (const Facet &facet : facets_of(cell))
  {
    const int t  = facet.inside >= 0 ? facet.inside : facet.outside;
    Outline &its = outlines[at(group[at(cell.mesh.material(t))])];
    ++its.n;
    its.triangle = its.triangle < 0 ? t : std::min(its.triangle, t);
    its.least    = std::min(its.least, facet.turn);
    its.most     = std::max(its.most, facet.turn);
    its.area += facet.area / cell.lattice.area();
  }
  std::vector<Finding> findings;
  for (std::size_t g = 0; g < outlines.size(); ++g)
  {
    const Outline &its = outlines[g];
    if (its.n == 0)
      continue;
    const meshes::Place place{(cell.mesh.vertices.row(cell.mesh.triangles(its.triangle, 0)) +
                               cell.mesh.vertices.row(cell.mesh.triangles(its.triangle, 1)) +
                               cell.mesh.vertices.row(cell.mesh.triangles(its.triangle, 2))) /
                                3.,
                              its.triangle, -1};
    std::ostringstream what;
    what.precision(3);
    what << "the outline of phase `" << cell.phases[at(phase_of_group[g])].name
         << "` is faceted: " << its.n << " of its sides turn by small equal angles, "
         << its.least * 180. / M_PI;
    if (its.most > 1.05 * its.least)
      what << " to " << its.most * 180. / M_PI;
    what << " degrees from each to the next, the first near (" << place.point(0) / metres_per_unit
         << ", " << place.point(1) / metres_per_unit
         << ") in the mesh's unit; the arcs through their vertices hold " << 100. * its.area
         << " % of the cell more, which no bracket of this mesh knows of";
    findings.push_back({Severity::warning, "faceted", what.str(),
                        "expected curved sides where an arc is meant: triangles with six nodes "
                        "(Gmsh: Mesh.ElementOrder = 2), whose bracket is that of the drawing; a "
                        "polygon that is meant may stay",
                        place});
  }
  return findings;
}
} // namespace homespun::homogenization
