// SPDX-License-Identifier: MIT
// Up-sampling with the modes of edges: the definition, and what does not fit.
#include "localization/upsampler.h"
#include "tests/localization/edge_cases.h"
#include "tests/localization/localization_cases.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::localization;
using homespun::tests::refusal;

namespace
{
constexpr int n1 = 5, n2 = 4;

struct Case
{
  Case()
      : cloth(tests::smooth_cell(tests::skewed_lattice(), 7, 6), n1, n2)
      , edges(tests::edges_of(cloth.cell))
  {
    options.anchor     = Anchor::mean;
    options.edges      = &edges;
    options.edge_kinds = {EdgeKind::free, EdgeKind::none, EdgeKind::clamped, EdgeKind::clamped};
  }
  tests::Cloth cloth;
  meshes::CellEdges edges;
  UpsamplerOptions options;
};

/// The closed form of edges_of() at a fine vertex, what it adds to w per unit strain; of the
/// clamped edges, then of the free one.
Eigen::Matrix<double, 2, 6> known_modes(const Case &of, const int vertex)
{
  const Eigen::RowVector2d at = of.cloth.sheet.fraction(of.cloth.sheet.mesh.vertices.row(vertex))
                                  .cwiseProduct(Eigen::RowVector2d(n1, n2));
  Eigen::Matrix<double, 2, 6> sum = Eigen::Matrix<double, 2, 6>::Zero();
  for (const int side : {0, 2, 3})
  {
    const int axis     = meshes::axis_of_side(side);
    const double depth = meshes::is_far_side(side) ? (axis == 0 ? n1 : n2) - at(axis) : at(axis);
    // A line between two cells belongs to the upper one.
    const double reach = of.edges.sides[static_cast<std::size_t>(side)].n_cells;
    if (meshes::is_far_side(side) ? depth > reach + 1e-9 : depth > reach - 1e-9)
      continue;
    for (int c = 0; c < 6; ++c)
    {
      const double wave = std::sin(2. * M_PI * at(1 - axis) + c + side);
      if (side == 0)
        sum(1, c) += 1e-3 * (wave - 0.2 * c) * std::exp(-2. * depth);
      else
        sum(0, c) += 1e-3 * (wave + 0.3 * c) * std::exp(-depth);
    }
  }
  return sum;
}

template <int dim>
void expect_the_definition(const Path path, const bool is_fitted)
{
  Case with;
  const meshes::FittedModes fitted = tests::fitted_to(with.cloth.cell);
  if (is_fitted)
    with.options.fitted = &fitted;
  with.options.path            = path;
  const Positions<dim> current = tests::wavy_motion<dim>(with.cloth.coarse.vertices);
  const auto fine              = tests::upsampled<dim>(with.cloth, current, with.options);
  UpsamplerOptions plain       = with.options;
  plain.edges                  = nullptr;
  const auto without           = tests::upsampled<dim>(with.cloth, current, plain);
  const CoarseFrames<dim> frames(with.cloth.coarse, with.options);
  const auto &values          = frames.values(current);
  Eigen::MatrixX3d of_clamped = values.leftCols(3), of_free = of_clamped;
  for (Eigen::Index v = 0; is_fitted && v < values.rows(); ++v)
  {
    const Eigen::Vector3d strain = of_free.row(v);
    of_clamped.row(v)            = meshes::FittedResponse(fitted).at(strain).head<3>();
    for (int a = 0; a < 3; ++a)
    {
      // No more than the strain, and nothing of the other sign.
      const double e = of_clamped(v, a);
      of_free(v, a)  = e * strain(a) <= 0. ? 0. : std::abs(e) < std::abs(strain(a)) ? e : strain(a);
    }
  }
  double largest = 0.;
  for (int v = 0; v < with.cloth.sheet.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d at = with.cloth.sheet.fraction(with.cloth.sheet.mesh.vertices.row(v))
                                    .cwiseProduct(Eigen::RowVector2d(n1, n2));
    const int i    = std::min(n1 - 1, static_cast<int>(at(0) + 1e-9)),
              j    = std::min(n2 - 1, static_cast<int>(at(1) + 1e-9));
    const double x = at(0) - i, y = at(1) - j;
    const int t = 2 * (j * n1 + i) + (y > x);
    const Eigen::Vector3d weights =
      y > x ? Eigen::Vector3d(1. - y, x, y - x) : Eigen::Vector3d(1. - x, x - y, y);
    Eigen::Matrix<double, 1, 3 + 2 *dim> frame = Eigen::Matrix<double, 1, 3 + 2 * dim>::Zero();
    const Eigen::Matrix<double, 2, 6> modes    = known_modes(with, v);
    Eigen::Vector2d w                          = Eigen::Vector2d::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const int corner = with.cloth.coarse.triangles(t, k);
      frame += weights(k) * values.row(corner);
      for (int a = 0; a < 3; ++a)
        w += weights(k) * (of_clamped(corner, a) * modes.row(0).segment<2>(2 * a) +
                           of_free(corner, a) * modes.row(1).segment<2>(2 * a));
    }
    const Eigen::Matrix<double, dim, 2> lift =
      Eigen::Map<const Eigen::Matrix<double, dim, 2, Eigen::RowMajor>>(frame.data() + 3);
    largest = std::max(
      largest, (fine.row(v) - without.row(v) - (lift * w).transpose()).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(largest, 1e-12 * with.cloth.sheet.sides().norm());
  EXPECT_GT((fine - without).cwiseAbs().maxCoeff(), 1e-5);
}
} // namespace

TEST(invariant_edge_modes, both_paths_agree_where_a_coarse_mesh_cuts_the_cells)
{
  Case with;
  const meshes::Sheet &sheet = with.cloth.sheet;
  with.cloth.coarse = meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors / 2, 2 * n1, 2 * n2);
  const Positions<3> current = tests::wavy_motion<3>(with.cloth.coarse.vertices);
  const auto shared          = tests::upsampled<3>(with.cloth, current, with.options);
  with.options.path          = Path::general;
  EXPECT_LT((shared - tests::upsampled<3>(with.cloth, current, with.options)).cwiseAbs().maxCoeff(),
            1e-15);
}

TEST(exact_edge_modes, positions_near_edges_are_those_of_the_definition)
{
  for (const Path path : {Path::automatic, Path::general})
  {
    expect_the_definition<2>(path, false);
    expect_the_definition<3>(path, false);
  }
}

TEST(exact_edge_modes, beside_fitted_modes_edges_follow_their_own_strains)
{
  for (const Path path : {Path::automatic, Path::general})
  {
    expect_the_definition<2>(path, true);
    expect_the_definition<3>(path, true);
  }
}

TEST(invariant_edge_modes, edges_without_modes_change_no_bit)
{
  Case of;
  of.options.edge_kinds      = {};
  const Positions<3> current = tests::wavy_motion<3>(of.cloth.coarse.vertices);
  const auto fine            = tests::upsampled<3>(of.cloth, current, of.options);
  of.options.edges           = nullptr;
  EXPECT_EQ((fine - tests::upsampled<3>(of.cloth, current, of.options)).cwiseAbs().maxCoeff(), 0.);
}

TEST(tripwire_edge_modes, anchored_chi_and_modes_of_another_cell_are_refused)
{
  Case of;
  const auto refused = [&]()
  {
    return refusal([&]
                   { Upsampler<3>(of.cloth.cell, of.cloth.coarse, of.cloth.sheet, of.options); });
  };
  of.options.anchor = Anchor::lattice;
  EXPECT_NE(refused().find("expected Anchor::mean"), std::string::npos);
  of.options.anchor = Anchor::mean;
  of.edges.sides[2].clamped.conservativeResize(5, 6);
  EXPECT_NE(refused().find("edge 2 has modes of 5"), std::string::npos);
}
