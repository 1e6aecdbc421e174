// SPDX-License-Identifier: MIT
// Modes of the edges of panels on lattice lines: far from seams those of a sheet, elsewhere the
// definition; none at seams and where an outline is no lattice line.
#include "meshes/plain/sheet.h"
#include "tests/localization/curved_cases.h"
#include "tests/localization/edge_cases.h"
#include "tests/localization/garment_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

using namespace homespun;
using namespace homespun::localization;
using tests::Garment;
using tests::Space;

namespace
{
constexpr int n1 = 6, n2 = 7;

Eigen::RowVector2d in_cells(const Garment &garment, const int v)
{
  const meshes::Grain &grain = garment.fine.grains[static_cast<std::size_t>(garment.fine.panel(v))];
  return garment.cell.lattice.fractional((garment.fine.rest.vertices.row(v) - grain.origin) *
                                         grain.rotation());
}

/// Two rectangles of n1 x n2 quads as large as a cell, the right side of the first sewn to the left
/// one of the second; how each lies against the lattice lines is said, in cells.
struct Rectangles
{
  Eigen::RowVector2d first = {0., 0.}, second = {0., 0.}; ///< place of the corner
  meshes::Grain grain = {{0.003, -0.002}, 0.};            ///< of the first

  int in_space(const int i, const int j) const
  {
    return j * (2 * n1 + 1) + i;
  }

  Garment sewn() const
  {
    const Eigen::Matrix2d cell = tests::skewed_lattice().vectors;
    const meshes::Grain other  = {{0.31, 0.2}, -0.4};
    meshes::ClothMesh cloth;
    cloth.positions.setZero((2 * n1 + 1) * (n2 + 1), 3);
    for (int i = 0; i <= 2 * n1; ++i)
      for (int j = 0; j <= n2; ++j)
        cloth.positions.row(in_space(i, j)).head<2>() = Eigen::RowVector2d(i, j) * cell;
    const meshes::TriangleMesh quads = meshes::coarse_sheet({0., 0.}, cell, n1, n2);
    const int n = quads.n_vertices(), m = quads.n_triangles();
    cloth.rest.vertices.resize(2 * n, 2);
    cloth.rest.triangles.resize(2 * m, 3);
    cloth.rest.material.setZero(2 * m);
    cloth.rest.vertices.topRows(n) =
      ((quads.vertices.rowwise() + first * cell) * grain.rotation().transpose()).rowwise() +
      grain.origin;
    cloth.rest.vertices.bottomRows(n) =
      ((quads.vertices.rowwise() + second * cell) * other.rotation().transpose()).rowwise() +
      other.origin;
    cloth.rest.triangles << quads.triangles, (quads.triangles.array() + n).matrix();
    cloth.triangles = cloth.rest.triangles.unaryExpr(
      [&](const int v) { return in_space(v % n % (n1 + 1) + (v < n ? 0 : n1), v % n / (n1 + 1)); });
    meshes::FineClothOptions options;
    options.grains = {grain, other};
    return {cloth, options};
  }
};

struct WithEdges
{
  explicit WithEdges(const Garment &garment)
      : garment(garment)
      , edges(tests::edges_of(garment.cell))
  {
    options.anchor     = Anchor::mean;
    options.edges      = &edges;
    options.edge_kinds = {EdgeKind::clamped, EdgeKind::free, EdgeKind::free, EdgeKind::clamped};
    options.slip       = Slip::added;
  }

  Space upsampled(const Space &current) const
  {
    return garment.upsampled(current, options);
  }

  /// As a garment whose outlines are no lattice lines.
  Space without_edges(const Space &current, const Anchor anchor) const
  {
    UpsamplerOptions plain = options;
    plain.edges            = nullptr;
    plain.anchor           = anchor;
    return garment.upsampled(current, plain);
  }

  Garment garment;
  meshes::CellEdges edges;
  UpsamplerOptions options;
};

Space moved(const Garment &garment)
{
  const meshes::Points flat = garment.coarse.positions.leftCols<2>();
  return tests::wavy_motion<3>(flat);
}

double side_of(const Garment &garment)
{
  return std::sqrt(garment.cell.lattice.area());
}

/// Compares with a sheet of the first panel, or of both where they are wider.
/// @param far by which a vertex of a panel is far enough from the seam [cells]
void expect_those_of_a_sheet(const WithEdges &with, const Space &current, const int n_along,
                             const double far)
{
  const Rectangles of;
  const Space fine = with.upsampled(current), none = with.without_edges(current, Anchor::mean);
  const tests::Cloth sheet(with.garment.cell, n_along, n2);
  Space of_sheet(sheet.coarse.n_vertices(), 3);
  for (int i = 0; i <= n_along; ++i)
    for (int j = 0; j <= n2; ++j)
      of_sheet.row(j * (n_along + 1) + i) = current.row(of.in_space(i, j));
  UpsamplerOptions options = with.options;
  if (n_along == n1)
    options.edge_kinds[1] = EdgeKind::none; // sewn
  const Space expected = tests::upsampled<3>(sheet, of_sheet, options);
  std::map<std::array<long, 2>, int> at;
  const auto key = [](const Eigen::RowVector2d &cells) {
    return std::array<long, 2>{std::lround(1e5 * cells(0)), std::lround(1e5 * cells(1))};
  };
  for (int v = 0; v < sheet.sheet.mesh.n_vertices(); ++v)
    at[key(sheet.sheet.fraction(sheet.sheet.mesh.vertices.row(v))
             .cwiseProduct(Eigen::RowVector2d(n_along, n2)))] = v;
  int n_compared = 0;
  double change  = 0.;
  for (int v = 0; v < with.garment.fine.n_vertices(); ++v)
  {
    const Eigen::RowVector2d cells =
      in_cells(with.garment, v) + Eigen::RowVector2d(n1 * with.garment.fine.panel(v), 0.);
    if (cells(0) > n_along || std::abs(cells(0) - n1) <= far)
      continue;
    EXPECT_LT((fine.row(v) - expected.row(at.at(key(cells)))).norm(), 1e-12 * side_of(with.garment))
      << cells;
    change = std::max(change, (fine.row(v) - none.row(v)).norm());
    ++n_compared;
  }
  EXPECT_GT(n_compared, 1000);
  EXPECT_GT(change, 1e-3 * side_of(with.garment));
}
} // namespace

TEST(exact_panel_edges, far_from_a_seam_a_panel_is_the_sheet_alone)
{
  const WithEdges with(Rectangles().sewn());
  expect_those_of_a_sheet(with, moved(with.garment), n1, 1.);
}

TEST(exact_panel_edges, beside_fitted_modes_far_from_a_seam_a_panel_is_the_sheet_alone)
{
  WithEdges with(Rectangles().sewn());
  const meshes::FittedModes fitted = tests::fitted_to(with.garment.cell);
  with.options.fitted              = &fitted;
  expect_those_of_a_sheet(with, moved(with.garment), n1, 1.);
}

TEST(exact_panel_edges, a_sheet_that_is_cut_and_sewn_is_the_sheet_but_where_w_fades)
{
  WithEdges with(Rectangles().sewn());
  with.options.edge_kinds[0]  = EdgeKind::free; // so that both panels have the slip of the top
  const meshes::Points flat   = with.garment.coarse.positions.leftCols<2>();
  const Space evenly_strained = tests::affine_motion<3>(flat, tests::some_stretch<3>());
  expect_those_of_a_sheet(with, evenly_strained, 2 * n1, 0.6);
}

TEST(invariant_panel_edges, a_turned_grain_and_whole_cells_of_shift_change_nothing)
{
  const Space expected = [&]()
  {
    const WithEdges with(Rectangles().sewn());
    return with.upsampled(moved(with.garment));
  }();
  Rectangles turned, shifted;
  turned.grain = {{-0.2, 0.7}, 1.1};
  shifted.grain.origin -= Eigen::RowVector2d(2., -1.) * tests::skewed_lattice().vectors;
  shifted.first = {2., -1.};
  for (const Rectangles &of : {turned, shifted})
  {
    const WithEdges with(of.sewn());
    const Space fine = with.upsampled(moved(with.garment));
    ASSERT_EQ(fine.rows(), expected.rows());
    EXPECT_LT((fine - expected).cwiseAbs().maxCoeff(), 1e-12 * side_of(with.garment));
  }
}

TEST(invariant_panel_edges, a_panel_off_lattice_lines_changes_no_bit_and_keeps_the_anchor)
{
  Rectangles of;
  of.second = {0.3, 0.3};
  WithEdges with(of.sewn());
  let_deflect(with.garment.cell);
  for (const Surface surface : {Surface::flat, Surface::curved})
  {
    with.options.surface = surface;
    const Space current = moved(with.garment), fine = with.upsampled(current),
                today = with.without_edges(current, Anchor::lattice);
    double first = 0., second = 0.;
    for (int v = 0; v < fine.rows(); ++v)
      (with.garment.fine.panel(v) == 0 ? first : second) += (fine.row(v) - today.row(v)).norm();
    EXPECT_EQ(second, 0.);
    EXPECT_GT(first, 1e-3);
  }
}

TEST(invariant_panel_edges, a_rigid_motion_and_a_mirror_move_the_fine_cloth_alike)
{
  const WithEdges with(Rectangles().sewn());
  const Space current = moved(with.garment), fine = with.upsampled(current);
  Eigen::Matrix3d Q =
    Eigen::AngleAxisd(2., Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
  const Eigen::RowVector3d to(0.03, -0.01, 0.02);
  for (const double mirror : {1., -1.})
  {
    Q.col(0) *= mirror;
    const Space other    = with.upsampled((current * Q.transpose()).rowwise() + to),
                expected = (fine * Q.transpose()).rowwise() + to;
    EXPECT_LT((other - expected).cwiseAbs().maxCoeff(), 1e-12 * side_of(with.garment));
  }
}

TEST(invariant_panel_edges, seams_stay_closed_beside_layers_and_slip)
{
  const WithEdges with(Rectangles().sewn());
  for (unsigned seed = 0; seed < 3; ++seed)
  {
    const Space current = tests::random_motion(with.garment.coarse, seed);
    EXPECT_LT(with.garment.seam_gap(with.upsampled(current)), 1e-16);
  }
}

namespace
{
/// An L of cells, 6 x 3 below and 3 x 3 above, with a slit from its top at x = 1 down to y = 4 and
/// a corner cut off between (5, 0) and (6, 1); coarse triangles halve the sides of cells, so that
/// their vertices come between those of the cells.
meshes::ClothMesh cut_out()
{
  const Eigen::Matrix2d cell       = tests::skewed_lattice().vectors;
  const meshes::TriangleMesh quads = meshes::coarse_sheet({0., 0.}, cell / 2., 12, 12);
  meshes::TriangleMesh mesh;
  std::map<std::pair<int, bool>, int> index;
  std::vector<Eigen::RowVector2d> points;
  std::vector<std::array<int, 3>> triangles;
  for (int t = 0; t < quads.n_triangles(); ++t)
  {
    Eigen::RowVector2d middle = Eigen::RowVector2d::Zero();
    for (const int v : quads.triangles.row(t))
      middle += quads.vertices.row(v) * cell.inverse() / 3.;
    const double x = middle(0), y = middle(1);
    if ((x > 3. && y > 3.) || x - 5. > y)
      continue;
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int v                 = quads.triangles(t, static_cast<int>(k));
      const bool is_right_of_slit = v % 13 == 2 && v / 13 > 8 && x > 1.;
      const auto [found, is_new] =
        index.try_emplace({v, is_right_of_slit}, static_cast<int>(points.size()));
      if (is_new)
        points.emplace_back(quads.vertices.row(v));
      corners[k] = found->second;
    }
    triangles.push_back(corners);
  }
  mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t v = 0; v < points.size(); ++v)
    mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.row(static_cast<Eigen::Index>(t)) =
      Eigen::RowVector3i(triangles[t][0], triangles[t][1], triangles[t][2]);
  mesh.material.setZero(mesh.n_triangles());
  return meshes::placed_sheet(mesh, Eigen::Matrix<double, 3, 2>::Identity(), {0., 0., 0.});
}

/// The closed form of tests::edges_of() for that panel, what it adds to w per unit strain.
/// @param point of which the modes are [cells]
/// @param place at which they are wanted, a middle inside beside it
Eigen::Matrix<double, 1, 6> modes_of_cut_out(const WithEdges &with, const Eigen::RowVector2d &point,
                                             const Eigen::RowVector2d &place,
                                             const Eigen::RowVector2d &middle)
{
  struct Edge
  {
    int side;
    double line;
    std::array<double, 2> ends;
    std::array<bool, 2> fades;
  };
  const std::array<Edge, 9> edges = {{{0, 0., {0., 6.}, {false, false}},
                                      {0, 1., {4., 6.}, {true, false}}, // the slit
                                      {1, 1., {4., 6.}, {true, false}},
                                      {1, 3., {3., 6.}, {true, false}},
                                      {1, 6., {1., 3.}, {true, false}},
                                      {2, 0., {0., 5.}, {false, true}},
                                      {3, 3., {3., 6.}, {true, false}},
                                      {3, 6., {0., 1.}, {false, false}},
                                      {3, 6., {1., 3.}, {false, false}}}};
  Eigen::Matrix<double, 1, 6> sum = Eigen::Matrix<double, 1, 6>::Zero();
  for (const Edge &edge : edges)
  {
    const int axis      = edge.side / 2;
    const auto depth_of = [&](const Eigen::RowVector2d &x)
    { return edge.side % 2 == 1 ? edge.line - x(axis) : x(axis) - edge.line; };
    const double depth = depth_of(point), along = place(1 - axis);
    const double reach = with.edges.sides[static_cast<std::size_t>(edge.side)].n_cells;
    const bool is_far  = edge.side % 2 == 1;
    if (depth < -1e-9 || depth_of(middle) < 0. || depth > reach + (is_far ? 1e-9 : -1e-9) ||
        middle(1 - axis) < edge.ends[0] || middle(1 - axis) > edge.ends[1])
      continue;
    if (axis == 0 && middle(1) > 4. && std::abs(middle(0) - 1.) < 1. &&
        (middle(0) > 1. ? edge.line == 0. : edge.line == 3.))
      continue; // behind the slit
    double part = 1.;
    for (std::size_t end = 0; end < 2; ++end)
      if (edge.fades[end])
      {
        const double s = std::min(std::abs(along - edge.ends[end]) / 0.5, 1.);
        part *= s * s * (3. - 2. * s);
      }
    const bool is_free = with.options.edge_kinds[static_cast<std::size_t>(edge.side)] == //
                         EdgeKind::free;
    for (int c = 0; c < 6; ++c)
    {
      const double wave = std::sin(2. * M_PI * point(1 - axis) + c + edge.side);
      sum(c) += part * (is_free ? 1e-3 * (wave - 0.2 * c) * std::exp(-2. * depth)
                                : 1e-3 * (wave + 0.3 * c) * std::exp(-depth));
    }
  }
  return sum;
}
} // namespace

TEST(exact_panel_edges, modes_of_an_outline_with_corners_slit_and_slope_are_the_definition)
{
  WithEdges with(Garment(cut_out(), {}));
  with.options.slip                   = Slip::of_cloth;
  const meshes::FineCloth &fine       = with.garment.fine;
  const meshes::HomogenizedCell &cell = with.garment.cell;
  const auto F                        = tests::some_stretch<3>();
  const auto frame                    = tests::frame_by_svd<3>(F);
  const Space current = tests::affine_motion<3>(with.garment.coarse.rest.vertices, F),
              change  = with.upsampled(current) - with.without_edges(current, Anchor::mean);
  int n_made = 0, n_on_slit = 0;
  for (int v = 0; v < fine.n_vertices(); ++v)
  {
    Eigen::RowVector2d middle = Eigen::RowVector2d::Zero();
    for (const int c : with.garment.coarse.rest.triangles.row(fine.coarse_triangle(v)))
      middle += cell.lattice.fractional(with.garment.coarse.rest.vertices.row(c)) / 3.;
    const Eigen::RowVector2d place = in_cells(with.garment, v);
    const bool is_made             = fine.cell_vertex(v) < 0;
    n_made += is_made ? 1 : 0;
    n_on_slit += std::abs(place(0) - 1.) < 1e-9 && place(1) > 4. + 1e-9 ? 1 : 0;
    Eigen::Matrix<double, 1, 6> modes = Eigen::Matrix<double, 1, 6>::Zero();
    if (!is_made)
      modes = modes_of_cut_out(with, place, place, middle);
    else
    {
      std::array<Eigen::RowVector2d, 3> corners;
      Eigen::RowVector2d from = place;
      for (int k = 0; k < 3; ++k)
      {
        auto &corner = corners[static_cast<std::size_t>(k)];
        corner       = cell.lattice.fractional(
                cell.mesh.vertices.row(cell.mesh.triangles(fine.cell_triangle(v), k)) -
                cell.mesh.vertices.row(cell.anchor));
        from -= fine.cell_weights(v, k) * corner;
      }
      for (int k = 0; k < 3; ++k)
        modes += fine.cell_weights(v, k) *
                 modes_of_cut_out(with, from + corners[static_cast<std::size_t>(k)], place, middle);
    }
    Eigen::Vector2d w = Eigen::Vector2d::Zero();
    for (int a = 0; a < 3; ++a)
      w += frame.strain(a) * modes.segment<2>(2 * a).transpose();
    EXPECT_LT((change.row(v).transpose() - frame.lift * w).norm(), 1e-11 * side_of(with.garment))
      << place << " made: " << is_made;
  }
  EXPECT_GT(n_made, 20);
  EXPECT_GT(n_on_slit, 20); // both sides
}
