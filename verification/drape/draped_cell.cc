// SPDX-License-Identifier: MIT
#include "verification/drape/draped_cell.h"

#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::verification
{
namespace
{
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

std::string why_not(const Term term, const Scene &scene, const std::optional<Law> law)
{
  if (term == Term::micro)
    return {};
  if (term == Term::curved)
    return scene.has("bending")
             ? std::string()
             : "` does not list `bending` among its `Terms`; expected it there: without it the "
               "curvature of the coarse cloth is that of wrinkles as fine as its mesh";
  if (!scene.is_sheet() && term != Term::modes)
    return "` is a garment, " +
           std::string(term == Term::edges ? "whose coarse cloth has no terms of edges"
                       : term == Term::p2  ? "whose panels six-node triangles do not fill"
                                           : "whose coarse cloth has no cubic energy") +
           "; expected a sheet: leave the term out";
  if ((term == Term::cubic || term == Term::modes) && law && !properties_of(*law).has_second_order)
    return "` has a cloth of the law " + name_of(*law) +
           ", which has no second order, and whose modes are fitted by `homespun strain` alone; "
           "expected another law by --variants, or leave the term out";
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

Method used_in(const Scene &scene, const Method &method, const std::optional<Law> law)
{
  Method left = method;
  for (const Term term : terms_of_scenes)
    if (!why_not(term, scene, law).empty())
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

CoarseStart::CoarseStart(const Scene &scene, const homogenization::UnitCell &cell)
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

HeldMotion CoarseStart::motion(const Scene &scene) const
{
  if (placement)
    return {scene, *placement, origin, sides};
  return {scene, mesh};
}

DrapedCell::DrapedCell(const Scene &given, const homogenization::UnitCell &cell,
                       const meshes::HomogenizedCell &homogenized, const Law law,
                       const std::optional<meshes::CellEdges> &edges)
    : scene(given)
    , cell(cell)
    , homogenized(homogenized)
    , edges(edges)
    , law(law)
    , side(std::sqrt(cell.lattice.area()))
{
  effective        = {law, {homogenized.stiffness}, {homogenized.areal_density}};
  phases.stiffness = cell.stiffness_of_phase();
  for (const Eigen::Matrix3d &C : phases.stiffness) // biot where no phase has yarns
    if (phases.law != law)
      phases.law = homogenized_law(law, C);
  phases.plate = shell::PlateModel::edge_angles; // order two, whatever mesh and phases
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
  CoarseStart begin(scene, cell);
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
  data.look         = meshes::ClothLook::of(rest.vertices, rest.triangles, rest.material);
}

Method DrapedCell::used(const Method &method) const
{
  Method left = used_in(scene, method, law);
  if (!edges)
    left = left.without(Term::edges);
  if (!homogenized.bending && left.has(Term::micro))
    left = left.without(Term::curved);
  for (const Term term : {Term::edges, Term::cubic, Term::modes, Term::curved})
    if (method.asks_for(term) && !left.has(term))
      throw meshes::BadInput(
        "--methods " + method.name + ": scene `" + scene.name +
        (why_not(term, scene, law).empty()
           ? "`: the cell " + cell.name + " has no " +
               (term == Term::curved ? "deflection of a bent sheet" : "terms of edges") +
               "; expected one that has: leave them out"
           : why_not(term, scene, law)));
  return left;
}

CoarseParts<3> DrapedCell::parts_of(const Method &method) const
{
  return {{homogenized, edges ? &*edges : nullptr}, *sheet, used(method), law, kinds_of_edges()};
}

ClothMaterial DrapedCell::effective_of(const Method &method) const
{
  ClothMaterial material = effective;
  if (sheet)
    material.parts = std::make_shared<const CoarseParts<3>>(parts_of(method));
  return material;
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
    return coarse_motion();
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
