// SPDX-License-Identifier: MIT
#include "verification/drape/draped_cell.h"

#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/yarn_axes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::verification
{
namespace
{
Law law_of_model(const MembraneModel model)
{
  return model == MembraneModel::woven ? Law::yarn : Law::biot;
}

int nearest_to_middle(const meshes::SpacePoints &positions)
{
  const Eigen::RowVector3d middle = positions.colwise().mean();
  Eigen::Index nearest            = 0;
  (positions.rowwise() - middle).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

meshes::ClothMesh placed(const meshes::TriangleMesh &rest, const SheetPlacement &placement)
{
  meshes::ClothMesh cloth;
  cloth.rest      = rest;
  cloth.triangles = rest.triangles;
  cloth.positions.resize(rest.n_vertices(), 3);
  for (int v = 0; v < rest.n_vertices(); ++v)
    cloth.positions.row(v) = placement.start(rest.vertices.row(v));
  return cloth;
}

std::string size_of(const Scene &sheet)
{
  return std::to_string(sheet.n1) + " x " + std::to_string(sheet.n2) + " cells";
}

/// The vertices of another sheet that are at the places of these.
std::vector<int> at_same_places(const std::vector<int> &vertices, const Scene &from,
                                const Scene &to, std::vector<std::string> &faults)
{
  std::vector<int> result;
  for (const int v : vertices)
  {
    const int i = v % (from.n1 + 1), j = v / (from.n1 + 1);
    const std::string name = from.file + ": held vertex " + std::to_string(v);
    if (j > from.n2)
      faults.push_back(name + " does not exist; expected 0 ... " +
                       std::to_string((from.n1 + 1) * (from.n2 + 1) - 1));
    else if (i * to.n1 % from.n1 != 0 || j * to.n2 % from.n2 != 0)
      faults.push_back(name + ", at (" + std::to_string(i) + ", " + std::to_string(j) + ") of " +
                       size_of(from) + ", is no vertex of a sheet of " + size_of(to) +
                       "; expected an edge or a corner by name, or --cells for which it is one");
    else
      result.push_back(j * to.n2 / from.n2 * (to.n1 + 1) + i * to.n1 / from.n1);
  }
  return result;
}
} // namespace

std::string why_not(const Term term, const Scene &scene, const MembraneModel model)
{
  if (term == Term::micro)
    return {};
  if (!scene.is_sheet())
    return "` is a garment, " +
           std::string(term == Term::edges ? "whose outlines and seams are no lattice lines"
                       : term == Term::p2  ? "whose panels six-node triangles do not fill"
                                           : "of which up-sampling has no second order") +
           "; expected a sheet: leave the term out";
  if ((term == Term::cubic || term == Term::modes) && model == MembraneModel::woven)
    return "` has a woven cloth, of which a scene has no second order, and whose modes are fitted "
           "by "
           "`homespun strain` alone; expected --variants corotational, or leave the term out";
  const bool has_forces_of_steps = term == Term::p2 || term == Term::cubic;
  if (has_forces_of_steps && scene.integration == TimeIntegration::conserving)
    return "` has the key `Integrator` = conserving, whose forces over a step are not known of it; "
           "expected another integrator";
  if (term == Term::p2 && (scene.n1 % 2 != 0 || scene.n2 % 2 != 0))
    return "` has " + std::to_string(scene.n1) + " x " + std::to_string(scene.n2) +
           " cells; expected even numbers, which six-node triangles two cells wide fill: another "
           "--cells, or leave the term out";
  if (term == Term::edges && !scene.has("selvedge"))
    return "` does not list `selvedge` among its `Terms`; expected it there: slip of clamped edges "
           "without tension of free ones can do harm";
  return {};
}

Method used_in(const Scene &scene, const Method &method, const MembraneModel model)
{
  Method left = method;
  for (const Term term : {Term::p2, Term::edges, Term::cubic, Term::modes})
    if (!why_not(term, scene, model).empty())
      left = left.without(term);
  return left;
}

bool has_own_cloth(const Method &used)
{
  return used.has(Term::edges) || used.has(Term::cubic) || used.has(Term::p2);
}

Scene scaled(const Scene &scene, const int n_cells)
{
  Scene result = scene;
  if (!scene.is_sheet())
    return result;
  const double ratio = static_cast<double>(n_cells) / scene.n1;
  result.n2          = std::max(1, static_cast<int>(std::lround(ratio * scene.n2)));
  result.n1          = n_cells;
  result.disturbance *= ratio;
  std::vector<std::string> faults;
  for (HeldPlace &held : result.held)
  {
    if (held.motion.kind == Motion::Kind::translate)
      held.motion.along *= ratio;
    held.vertices = at_same_places(held.vertices, scene, result, faults);
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return result;
}

CoarseCloth::CoarseCloth(const Scene &scene, const homogenization::UnitCell &cell)
{
  if (!scene.is_sheet())
  {
    mesh = meshes::read_cloth(scene.mesh_file, scene.vt_unit);
    mesh.rest.material.setZero(mesh.n_triangles());
    return;
  }
  const meshes::Sheet first = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  origin                    = first.origin;
  sides     = Eigen::Vector2d(scene.n1, scene.n2).asDiagonal() * first.lattice.vectors;
  placement = placement_of(scene, origin, sides);
  meshes::TriangleMesh rest =
    meshes::coarse_sheet(origin, first.lattice.vectors, scene.n1, scene.n2);
  rest.material = Eigen::VectorXi::Zero(rest.n_triangles());
  mesh          = placed(rest, *placement);
}

HeldMotion CoarseCloth::motion(const Scene &scene) const
{
  if (placement)
    return {scene, *placement, origin, sides};
  return {scene, mesh};
}

DrapedCell::DrapedCell(const Scene &given, const homogenization::UnitCell &cell,
                       const meshes::HomogenizedCell &homogenized,
                       const std::optional<meshes::CellEdges> &edges, const MembraneModel model)
    : scene(given)
    , cell(cell)
    , homogenized(homogenized)
    , edges(edges)
    , model(model)
    , side(std::sqrt(cell.lattice.area()))
{
  if (model == MembraneModel::woven && !meshes::yarn_axes(homogenized.stiffness).are_there)
    throw meshes::BadInput("--variants " + name_of(model) + ": C^H of " + cell.file +
                           " is alike in all directions and has no yarns; expected a cell whose "
                           "C^H has axes, or corotational");
  effective        = {{homogenized.stiffness}, {homogenized.areal_density}};
  phases.stiffness = cell.stiffness_of_phase();
  phases.plate     = shell::PlateModel::edge_angles; // order two, whatever mesh and phases
  for (const homogenization::Phase &phase : cell.phases)
    phases.areal_density.push_back(phase.thickness * phase.density);
  if (scene.has("bending") && !scene.bending)
  {
    if (!homogenized.bending)
      throw meshes::BadInput(scene.file + ": key `Bending stiffness` = cell: " + cell.file +
                             " has no D^H; expected one with a bracket (`homespun homogenize` says "
                             "why it has none), or numbers in N m");
    effective.bending = {shell::PlateStiffness::from(homogenized.bending->stiffness)};
    for (const Eigen::Matrix3d &D : cell.bending_stiffness_of_phase())
      phases.bending.push_back(shell::PlateStiffness::from(D));
  }
  CoarseCloth begin(scene, cell);
  coarse    = std::move(begin.mesh);
  placement = begin.placement;
  if (scene.is_sheet())
  {
    sheet = meshes::tile(cell.mesh, cell.lattice, scene.n1, scene.n2);
    fine  = placed(sheet->mesh, *placement);
  }
  else
  {
    garment = meshes::fine_cloth(cell.mesh, cell.lattice, coarse);
    // Vertices in space are numbered without gaps.
    space_vertex.assign(static_cast<std::size_t>(garment->n_vertices()), -1);
    int n = 0;
    for (int v = 0; v < garment->n_vertices(); ++v)
    {
      const int first = garment->same_in_space(v);
      space_vertex[static_cast<std::size_t>(v)] =
        first == v ? n++ : space_vertex[static_cast<std::size_t>(first)];
    }
    fine.rest = garment->rest;
    fine.positions.resize(n, 3);
    fine.triangles = garment->rest.triangles;
    for (int t = 0; t < fine.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        fine.triangles(t, k) = space_vertex[static_cast<std::size_t>(fine.triangles(t, k))];
    fine_of_coarse.assign(static_cast<std::size_t>(coarse.n_vertices()), -1);
    for (int v = 0; v < garment->n_vertices(); ++v)
    {
      Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
      for (int k = 0; k < 3; ++k)
      {
        const int corner = coarse.triangles(garment->coarse_triangle(v), k);
        at += garment->coarse_weights(v, k) * coarse.positions.row(corner);
        if (garment->coarse_weights(v, k) > 1. - 1e-9)
          fine_of_coarse[static_cast<std::size_t>(corner)] =
            space_vertex[static_cast<std::size_t>(v)];
      }
      fine.positions.row(space_vertex[static_cast<std::size_t>(v)]) = at;
    }
  }
  centre_vertex      = nearest_to_middle(coarse.positions);
  fine_centre_vertex = nearest_to_middle(at_fine_vertices(fine.positions));

  const std::vector<int> group_of_phase = cell.group_of_phase();
  const meshes::TriangleMesh &rest      = sheet ? sheet->mesh : garment->rest;
  Eigen::VectorXf material(rest.n_triangles());
  for (int t = 0; t < rest.n_triangles(); ++t)
    material(t) = static_cast<float>(group_of_phase[static_cast<std::size_t>(rest.material(t))]);
  data.on_triangles = {{"material", material}};
}

Law DrapedCell::law() const
{
  return law_of_model(model);
}

Method DrapedCell::used(const Method &method) const
{
  Method left = used_in(scene, method, model);
  if (!edges)
    left = left.without(Term::edges);
  for (const Term term : {Term::edges, Term::cubic, Term::modes})
    if (method.asks_for(term) && !left.has(term))
      throw meshes::BadInput("--methods " + method.name + ": scene `" + scene.name +
                             (why_not(term, scene, model).empty()
                                ? "`: the cell " + cell.name +
                                    " has no terms of edges; expected "
                                    "one that has: leave them out"
                                : why_not(term, scene, model)));
  return left;
}

CoarseSpace DrapedCell::coarse_space(const Method &method) const
{
  if (!sheet)
    throw meshes::BadInput(scene.file + ": method " + method.name +
                           " is one of sheets, and the cloth is a garment; expected a sheet of "
                           "whole cells: leave out the method");
  return {*sheet, element_of(method)};
}

MovingEdges DrapedCell::moving_edges(const Method &method) const
{
  if (!edges)
    throw meshes::BadInput(scene.file + ": terms of edges are asked for, and the cell " +
                           cell.name + " has none; expected a sheet of whole cells: leave out `" +
                           method.name + "`");
  const CoarseSpace space = coarse_space(method);
  return {homogenized, *edges, *sheet, space, coarse_motion().vertices(coarse)};
}

ClothMaterial DrapedCell::effective_of(const Method &asked) const
{
  const Method method    = used(asked);
  ClothMaterial material = effective;
  if (method.has(Term::cubic))
  {
    const auto found = homogenized.second_order.find(name_of(law()));
    if (found == homogenized.second_order.end())
      throw meshes::BadInput("method " + method.name + ": the cell " + cell.name +
                             " has no cubic energy under the law " + name_of(law()) +
                             "; expected one: leave the method out");
    material.cubic = {found->second.energy};
  }
  if (method.has(Term::edges))
    material.edges = std::make_shared<const MovingEdges>(moving_edges(method));
  if (method.has(Term::p2))
  {
    const CoarseSpace space = coarse_space(method);
    material.six_nodes      = std::make_shared<const shell::SixNodeMesh>(
      shell::six_node_mesh(space.nodes.mesh, space.nodes.n1, space.nodes.n2));
  }
  return material;
}

MembraneModel DrapedCell::fine_model() const
{
  const bool has_yarns = std::any_of(phases.stiffness.begin(), phases.stiffness.end(),
                                     [](const Eigen::Matrix3d &stiffness)
                                     { return meshes::yarn_axes(stiffness).are_there; });
  return model == MembraneModel::woven && has_yarns ? model : MembraneModel::corotational;
}

HeldMotion DrapedCell::coarse_motion() const
{
  if (sheet)
    return {scene, *placement, sheet->origin, sheet->sides()};
  return {scene, coarse};
}

HeldMotion DrapedCell::fine_motion() const
{
  if (sheet)
    return {scene, *placement, sheet->origin, sheet->sides()};
  return {scene, coarse, fine_of_coarse};
}

int DrapedCell::n_fine() const
{
  return sheet ? sheet->mesh.n_vertices() : garment->n_vertices();
}

meshes::Triangles DrapedCell::fine_triangles() const
{
  return sheet ? sheet->mesh.triangles : garment->sewn_triangles();
}

meshes::SpacePoints DrapedCell::at_fine_vertices(const meshes::SpacePoints &positions) const
{
  if (sheet)
    return positions;
  meshes::SpacePoints result(garment->n_vertices(), 3);
  for (int v = 0; v < garment->n_vertices(); ++v)
    result.row(v) = positions.row(space_vertex[static_cast<std::size_t>(v)]);
  return result;
}
} // namespace homespun::verification
