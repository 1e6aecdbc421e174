// SPDX-License-Identifier: MIT
#include "verification/method/edge_terms.h"

#include "meshes/plain/errors.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
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

/// The middle of an edge, in fractions of the sheet.
Eigen::RowVector2d middle_of(const int side)
{
  Eigen::RowVector2d fraction(0.5, 0.5);
  fraction(meshes::axis_of_side(side)) = meshes::is_far_side(side) ? 1. : 0.;
  return fraction;
}

using Row7 = Eigen::Matrix<double, 1, 7>;

/// The lift of a row of CoarseFrames::values().
Eigen::Matrix2d lift_of(const Row7 &frame)
{
  Eigen::Matrix2d lift;
  lift << frame(3), frame(4), frame(5), frame(6);
  return lift;
}

/// Of each vertex of the cell that lies where a lattice coordinate is smallest or largest, its
/// image at the other end.
std::vector<int> images_across(const meshes::HomogenizedCell &cell, const int axis)
{
  const meshes::ImageClasses images = meshes::match_images(cell.mesh.vertices, cell.lattice);
  const int n                       = cell.mesh.n_vertices();
  const Eigen::RowVector2d origin   = cell.mesh.vertices.row(cell.anchor);
  const auto is_high                = [&](const int v)
  { return cell.lattice.fractional(cell.mesh.vertices.row(v) - origin)(axis) > 0.5; };
  std::vector<std::array<int, 2>> ends(static_cast<std::size_t>(n), {-1, -1});
  std::vector<int> across(static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v)
    ends[static_cast<std::size_t>(images.representative[static_cast<std::size_t>(v)])][is_high(v)] =
      v;
  for (int v = 0; v < n; ++v)
  {
    const auto &of_class =
      ends[static_cast<std::size_t>(images.representative[static_cast<std::size_t>(v)])];
    const int other                     = of_class[is_high(v) ? 0 : 1];
    across[static_cast<std::size_t>(v)] = other < 0 ? v : other;
  }
  return across;
}
} // namespace

EdgeTerms::EdgeTerms(const CellWithEdges &of, const meshes::Sheet &sheet, const Load &load,
                     CoarseGrid of_grid, const Law law)
    : grid(std::move(of_grid))
    , law(law)
    , cell(of.cell)
    , edges(of.edges)
    , sheet(sheet)
    , frames(grid.mesh, options_of(law))
{
  if (load.is_periodic())
    throw meshes::BadInput("method edges: load " + load.name +
                           " is one of an infinite cloth, which has no edges; expected strip-1, "
                           "strip-2 or shear-frame");
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    is_clamped[static_cast<std::size_t>(side)] = load.holds(middle_of(side));
    find_members(side);
  }
}

void EdgeTerms::find_members(const int side)
{
  const int axis                  = meshes::axis_of_side(side);
  const bool is_far               = meshes::is_far_side(side);
  const meshes::CellEdge &edge    = edges.sides[static_cast<std::size_t>(side)];
  const std::vector<int> across   = images_across(cell, axis);
  const Eigen::RowVector2d origin = cell.mesh.vertices.row(cell.anchor);
  const int n_along               = axis == 0 ? sheet.n1 : sheet.n2;
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    // In which cell from the edge, and as which vertex of it: one on a line between two cells is
    // taken as the lower end of the upper one, but on the last line.
    int image                         = sheet.cell_vertex(v);
    const Eigen::RowVector2d fraction = sheet.fraction(sheet.mesh.vertices.row(v));
    const double along                = fraction(axis) * n_along;
    const int of_cell = std::clamp(static_cast<int>(std::floor(along + 1e-6)), 0, n_along - 1);
    const double rest = along - of_cell;
    const double f    = cell.lattice.fractional(cell.mesh.vertices.row(image) - origin)(axis);
    if (std::abs(f - rest) > 0.5)
      image = across[static_cast<std::size_t>(image)];
    const int depth = is_far ? n_along - 1 - of_cell : of_cell;
    if (depth >= edge.n_cells)
      continue;
    const double s = fraction(0) * grid.n1, t = fraction(1) * grid.n2;
    const int i    = std::clamp(static_cast<int>(std::floor(s)), 0, grid.n1 - 1);
    const int j    = std::clamp(static_cast<int>(std::floor(t)), 0, grid.n2 - 1);
    const double x = s - i, y = t - j;
    members.push_back(
      {v, 2 * (j * grid.n1 + i) + (y > x),
       y > x ? Eigen::Vector3d(1. - y, x, y - x) : Eigen::Vector3d(1. - x, x - y, y),
       is_clamped[static_cast<std::size_t>(side)] ? &edge.clamped : &edge.free,
       static_cast<Eigen::Index>(depth) * cell.mesh.n_vertices() + image});
  }
}

EdgeTerms::MacroLoads EdgeTerms::macro_loads(const Positions &positions) const
{
  const auto &of_vertices = frames.values(positions);
  MacroLoads loads        = {Positions::Zero(grid.mesh.n_vertices(), 2),
                             Positions::Zero(grid.mesh.n_vertices(), 2)};
  add_bulk_forces(of_vertices, loads.forces);
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
    add_side(side, of_vertices, loads);
  return loads;
}

/// −integral M_abc d_b E_a E_c(v), the gradient that of the strains at the vertices.
void EdgeTerms::add_bulk_forces(
  const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> &of_vertices,
  Positions &forces) const
{
  for (int t = 0; t < grid.mesh.n_triangles(); ++t)
  {
    Eigen::Matrix2d spans;
    for (int k = 0; k < 2; ++k)
      spans.col(k) = (grid.mesh.vertices.row(grid.mesh.triangles(t, k + 1)) -
                      grid.mesh.vertices.row(grid.mesh.triangles(t, 0)))
                       .transpose();
    Eigen::Matrix<double, 2, 3> slopes;
    slopes.rightCols<2>()                = spans.inverse().transpose();
    slopes.col(0)                        = -slopes.col(1) - slopes.col(2);
    Eigen::Matrix<double, 2, 3> gradient = Eigen::Matrix<double, 2, 3>::Zero(); // d_b E_a
    Row7 mean                            = Row7::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const Row7 frame = of_vertices.row(grid.mesh.triangles(t, k));
      gradient += slopes.col(k) * frame.head<3>();
      mean += frame / 3.;
    }
    Eigen::RowVector3d stress = Eigen::RowVector3d::Zero(); // of E_c(v)
    for (int b = 0; b < 2; ++b)
      stress += gradient.row(b) * edges.bulk[static_cast<std::size_t>(b)];
    Eigen::Matrix2d tensor;
    tensor << stress(0), stress(2), stress(2), stress(1);
    const Eigen::Matrix2d nominal = 0.5 * spans.determinant() * lift_of(mean) * tensor;
    for (int k = 0; k < 3; ++k)
      forces.row(grid.mesh.triangles(t, k)) -= (nominal * slopes.col(k)).transpose();
  }
}

/// Slip of a clamped edge; of a free one −integral T_a E_a t . dv/ds ds.
void EdgeTerms::add_side(
  const int side, const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> &of_vertices,
  MacroLoads &loads) const
{
  const int axis               = meshes::axis_of_side(side);
  const meshes::CellEdge &edge = edges.sides[static_cast<std::size_t>(side)];
  const int n                  = axis == 0 ? grid.n2 : grid.n1;
  const int across             = axis == 0 ? grid.n1 : grid.n2;
  const int fixed              = meshes::is_far_side(side) ? across : 0;
  const auto vertex            = [&](const int k)
  { return axis == 0 ? k * (grid.n1 + 1) + fixed : fixed * (grid.n1 + 1) + k; };
  if (is_clamped[static_cast<std::size_t>(side)])
  {
    for (int k = 0; k <= n; ++k)
    {
      const Row7 frame = of_vertices.row(vertex(k));
      loads.slip.row(vertex(k)) =
        (lift_of(frame) * edge.slip * frame.head<3>().transpose()).transpose();
    }
    return;
  }
  const Eigen::Vector2d along = sheet.lattice.vectors.row(1 - axis).transpose().normalized();
  for (int k = 0; k < n; ++k)
  {
    const Row7 frame = 0.5 * (of_vertices.row(vertex(k)) + of_vertices.row(vertex(k + 1)));
    const Eigen::RowVector2d pull =
      frame.head<3>().dot(edge.tension.transpose()) * (lift_of(frame) * along).transpose();
    loads.forces.row(vertex(k)) += pull;
    loads.forces.row(vertex(k + 1)) -= pull;
  }
}

void EdgeTerms::add_modes(const Positions &positions, meshes::Points &fine) const
{
  const auto &of_vertices = frames.values(positions);
  for (const Member &member : members)
  {
    Row7 frame = Row7::Zero();
    for (int k = 0; k < 3; ++k)
      frame += member.weights(k) * of_vertices.row(grid.mesh.triangles(member.triangle, k));
    const auto modes  = member.modes->row(member.row);
    Eigen::Vector2d w = Eigen::Vector2d::Zero();
    for (int a = 0; a < 3; ++a)
      w += frame(a) * modes.segment<2>(2 * a).transpose();
    fine.row(member.vertex) += (lift_of(frame) * w).transpose();
  }
}

EdgeTerms::Positions with_edges(const EdgeTerms &terms, const CoarseSpace &space,
                                const CoarseSolver &solver, const EdgeTerms::Positions &positions)
{
  const EdgeTerms::MacroLoads loads = terms.macro_loads(space.on_grid(positions));
  const EdgeTerms::Positions slip   = space.at_nodes(loads.slip),
                             forces = space.loads_of_nodes(loads.forces);
  if (terms.law == Law::linear)
  {
    const meshes::Points &rest = space.nodes.mesh.vertices;
    return positions + (solver.solve_linear(rest + slip, forces) - rest);
  }
  return solver.solve_equilibrium(terms.law, positions + slip, forces).positions;
}

bool has_meaning(const Method &method, const Load &load)
{
  return !load.is_periodic() || !(method.has_edge_terms() || method.has_six_nodes());
}

bool has_meaning(const Method &method, const Law law, const Load &load)
{
  return method.has_meaning(law) && has_meaning(method, load);
}

namespace
{
/// The vertices of a coarse mesh that a load holds; none of an infinite cloth.
std::vector<int> held_by(const Load &load, const meshes::Sheet &sheet,
                         const meshes::TriangleMesh &mesh)
{
  std::vector<int> held;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (!load.is_periodic() && load.holds(sheet.fraction(mesh.vertices.row(v))))
      held.push_back(v);
  return held;
}
} // namespace

EdgedSheet::EdgedSheet(const CellWithEdges &cell, const meshes::Sheet &sheet, const Load &load,
                       const Method &method, const int quads_per_cell)
    : cell(cell)
    , sheet(sheet)
    , load(load)
    , method(method)
    , space(sheet, method.coarse(Law::linear).element, quads_per_cell)
{
  const std::vector<int> held = held_by(load, sheet, space.nodes.mesh);
  solvers[""]                 = space.solver(cell.cell.stiffness, held);
  if (method.is_of_second_order())
    for (const auto &[law, second] : cell.cell.second_order)
      solvers[law] = space.solver(cell.cell.stiffness, held, {second.energy});
}

UpsampledSheet EdgedSheet::upsample(const Law law,
                                    const EdgeTerms::Positions &coarse_positions) const
{
  const EdgeTerms terms(cell, sheet, load, space.grid, law);
  const localization::UpsamplerOptions options = method.options(law);
  const auto found = solvers.find(method.is_of_second_order(law) ? name_of(law) : "");
  if (found == solvers.end())
    throw meshes::BadInput("method " + method.name +
                           ": the cell has no cubic energy under the law " + name_of(law));
  const auto moved_grid = [&]()
  { return space.on_grid(with_edges(terms, space, *found->second, coarse_positions)); };
  UpsampledSheet result;
  const EdgeTerms::Positions moved = moved_grid();
  localization::Upsampler<2, double>::Fine in_double;
  localization::Upsampler<2, double>(cell.cell, space.grid.mesh, sheet, options)
    .upsample(moved, in_double);
  result.positions = in_double;
  terms.add_modes(moved, result.positions);

  const localization::Upsampler<2, float> in_float(cell.cell, space.grid.mesh, sheet, options);
  localization::Upsampler<2, float>::Fine fine;
  meshes::Points near_edges = meshes::Points::Zero(sheet.mesh.n_vertices(), 2);
  const auto run            = [&]()
  {
    const EdgeTerms::Positions again = moved_grid();
    in_float.upsample(again, fine);
    terms.add_modes(again, near_edges);
  };
  run(); // memory and caches, as in every frame but the first
  result.seconds = median_seconds(run);
  return result;
}

std::string EdgedSheet::sentence() const
{
  std::string clamped, free;
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    std::string &list = load.holds(middle_of(side)) ? clamped : free;
    list += std::string(list.empty() ? "" : " and ") + "axis " +
            std::to_string(meshes::axis_of_side(side) + 1) +
            (meshes::is_far_side(side) ? ", far end (" : ", near end (") +
            std::to_string(cell.edges.sides[static_cast<std::size_t>(side)].n_cells) + " cells)";
  }
  return "method " + method.name +
         ": all edges of the sheet are lattice lines and have their terms; clamped, "
         "with slip and modes: " +
         clamped + "; free, with tension and modes: " + free;
}
} // namespace homespun::verification
