// SPDX-License-Identifier: MIT
// Up-sampling with quadratic modes.
#include "tests/localization/fine_position.h"
#include "tests/localization/garment_cases.h"
#include "tests/localization/localization_cases.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

using namespace homespun;
using namespace homespun::localization;
using homespun::tests::refusal;

namespace
{
/// smooth_cell() with quadratic modes, all columns different, zero at the lattice points.
tests::Cloth cloth_of_second_order()
{
  tests::Cloth cloth               = tests::skewed_cloth();
  meshes::SecondOrder &second      = cloth.cell.second_order["biot"];
  const meshes::TriangleMesh &mesh = cloth.cell.mesh;
  second.chi.resize(mesh.n_vertices(), 12);
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = 2. * M_PI * cloth.cell.lattice.fractional(mesh.vertices.row(v));
    for (int k = 0; k < 12; ++k)
      second.chi(v, k) = 2e-4 * (std::sin(f(0) + k) + (k % 5 - 2) * std::cos(f(1) - 3 * k));
  }
  second.chi.rowwise() -= Eigen::Matrix<double, 1, 12>(second.chi.row(0));
  return cloth;
}

UpsamplerOptions of_second_order()
{
  UpsamplerOptions options;
  options.second_order = "biot";
  return options;
}

/// fine_position() of the vertices that lie inside a coarse triangle of their cell.
template <int dim>
void expect_the_definition(const UpsamplerOptions &options)
{
  const tests::Cloth cloth     = cloth_of_second_order();
  const Positions<dim> current = tests::wavy_motion<dim>(cloth.coarse.vertices);
  const auto fine              = tests::upsampled<dim>(cloth, current, options);
  const CoarseFrames<dim> frames(cloth.coarse, options);
  const meshes::Chi chi = anchored(cloth.cell, options.anchor);
  const meshes::QuadraticChi quadratic =
    anchored_quadratic(cloth.cell, options.second_order, options.anchor);
  int n_compared = 0;
  for (int t = 0; t < cloth.coarse.n_triangles(); ++t)
  {
    Eigen::Matrix2d edges;
    const Eigen::RowVector2d origin = cloth.coarse.vertices.row(cloth.coarse.triangles(t, 0));
    for (int k = 0; k < 2; ++k)
      edges.row(k) = cloth.coarse.vertices.row(cloth.coarse.triangles(t, k + 1)) - origin;
    const Eigen::Matrix2d inverse = edges.inverse();
    for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
    {
      const Eigen::RowVector2d b = (cloth.sheet.mesh.vertices.row(v) - origin) * inverse;
      const Eigen::Vector3d weights(1. - b.sum(), b(0), b(1));
      if (weights.minCoeff() < 1e-6)
        continue;
      ++n_compared;
      const int image                              = cloth.sheet.cell_vertex(v);
      const Eigen::Matrix<double, dim, 1> expected = tests::fine_position<dim>(
        frames, t, weights, chi.row(image), current, quadratic.row(image));
      EXPECT_LT((fine.row(v).transpose() - expected).norm(), 1e-15) << "vertex " << v;
    }
  }
  EXPECT_GT(n_compared, 100);
}
} // namespace

TEST(exact_upsampler_second_order, positions_are_those_of_the_definition_on_both_paths)
{
  for (const Path path : {Path::automatic, Path::general})
    for (const Blend blend : {Blend::continuous, Blend::piecewise})
      for (const Lift lift : {Lift::rotation, Lift::identity})
      {
        UpsamplerOptions options = of_second_order();
        options.path             = path;
        options.blend            = blend;
        options.lift             = lift;
        expect_the_definition<2>(options);
        expect_the_definition<3>(options);
      }
}

TEST(exact_upsampler_second_order, both_paths_agree_where_a_coarse_mesh_halves_the_cells)
{
  tests::Cloth cloth = cloth_of_second_order();
  cloth.coarse       = meshes::coarse_sheet(cloth.sheet.origin, cloth.sheet.lattice.vectors / 2,
                                            2 * cloth.sheet.n1, 2 * cloth.sheet.n2);
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  UpsamplerOptions general   = of_second_order();
  general.path               = Path::general;
  EXPECT_LT((tests::upsampled<3>(cloth, current, of_second_order()) -
             tests::upsampled<3>(cloth, current, general))
              .cwiseAbs()
              .maxCoeff(),
            1e-15);
}

// From the formula of meshes::SecondOrder, mode by mode: what the definition itself has to say.
TEST(exact_upsampler_second_order, each_mode_is_taken_by_its_own_product_of_strains)
{
  tests::Cloth cloth = cloth_of_second_order();
  cloth.cell.chi.setZero();
  const meshes::QuadraticChi all = cloth.cell.second_order.at("biot").chi;
  const double a = 0.08, b = -0.05, c = 0.03;
  Eigen::Matrix2d U;
  U << 1. + a, 0.5 * c, 0.5 * c, 1. + b;
  const Positions<2> current          = tests::affine_motion<2>(cloth.coarse.vertices, U),
                     even             = tests::affine_motion<2>(cloth.sheet.mesh.vertices, U);
  const std::array<double, 6> factors = {0.5 * a * a, 0.5 * b * b, 0.5 * c * c,
                                         a * b,       a * c,       b * c};
  for (int k = 0; k < 6; ++k)
  {
    meshes::QuadraticChi &one = cloth.cell.second_order.at("biot").chi;
    one.setZero();
    one.middleCols<2>(2 * k) = all.middleCols<2>(2 * k);
    const auto fine          = tests::upsampled<2>(cloth, current, of_second_order());
    for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
    {
      const Eigen::RowVector2d w = -factors[static_cast<std::size_t>(k)] *
                                   all.row(cloth.sheet.cell_vertex(v)).segment<2>(2 * k);
      EXPECT_LT((fine.row(v) - even.row(v) - w).norm(), 1e-16 * 10.) << "mode " << k;
    }
  }
}

namespace
{
/// cloth_of_second_order() with modes of no law.
struct Fitted
{
  Fitted()
      : cloth(cloth_of_second_order())
  {
    modes.low << -0.05, -0.06, -0.2;
    modes.high << 0.3, 0.2, 0.1;
    modes.knees << 0.02, 0.5, 0.2;
    modes.modes = cloth.cell.second_order.at("biot").chi;
    for (int j = 0; j < meshes::FittedModes::n_functions; ++j)
      for (int k = 0; k < meshes::FittedModes::n_modes; ++k)
        modes.coefficients(j, k) = std::sin(3. * j + 5. * k * k);
    options.fitted = &modes;
  }

  tests::Cloth cloth;
  meshes::FittedModes modes;
  UpsamplerOptions options;
};
} // namespace

// From the formulas of meshes/plain/fitted_modes.h, written out once more.
TEST(exact_upsampler_fitted, modes_are_taken_by_their_coefficients_in_the_plane_and_in_space)
{
  Fitted with;
  tests::Cloth &cloth = with.cloth;
  cloth.cell.chi.setZero();
  for (const Eigen::Vector3d &E :
       {Eigen::Vector3d(0.08, -0.05, 0.03), Eigen::Vector3d(-0.03, 0.1, -0.15),
        Eigen::Vector3d(0.08, 0.5, 0.2)}) // the last one beyond the box
  {
    Eigen::Matrix2d U;
    U << 1. + E(0), 0.5 * E(2), 0.5 * E(2), 1. + E(1);
    const Eigen::Vector3d inside(E(0), std::min(E(1), 0.2), std::min(E(2), 0.1));
    const Eigen::Vector3d s(inside(0) / (0.02 + std::abs(inside(0))),
                            inside(1) / (0.5 + std::abs(inside(1))), inside(2) / 0.2);
    const std::vector<std::array<int, 3>> powers = {{0, 0, 1}, {0, 0, 2}, {0, 1, 0},
                                                    {0, 1, 1}, {0, 2, 0}, {1, 0, 0},
                                                    {1, 0, 1}, {1, 1, 0}, {2, 0, 0}};
    std::vector<double> functions;
    for (int a = 0; a < 3; ++a)
      for (const auto &[p, q, r] : powers)
        functions.push_back(inside(a) * std::pow(s(0), p) * std::pow(s(1), q) * std::pow(s(2), r));
    const Positions<2> even    = tests::affine_motion<2>(cloth.sheet.mesh.vertices, U),
                       current = tests::affine_motion<2>(cloth.coarse.vertices, U);
    Positions<3> in_space      = Positions<3>::Zero(cloth.coarse.n_vertices(), 3);
    in_space.leftCols<2>()     = current;
    const auto fine            = tests::upsampled<2>(cloth, current, with.options);
    const auto fine_in_space   = tests::upsampled<3>(cloth, in_space, with.options);
    for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
    {
      Eigen::RowVector2d w = Eigen::RowVector2d::Zero();
      for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 27; ++j)
          w -= functions[static_cast<std::size_t>(j)] * with.modes.coefficients(j, k) *
               with.modes.modes.row(cloth.sheet.cell_vertex(v)).segment<2>(2 * k);
      ASSERT_LT((fine.row(v) - even.row(v) - w).norm(), 1e-15) << v;
      ASSERT_LT((fine_in_space.row(v).head<2>() - even.row(v) - w).norm(), 1e-15) << v;
    }
  }
}

TEST(exact_upsampler_fitted, both_paths_agree_where_the_strain_varies)
{
  Fitted with;
  const Positions<3> current = tests::wavy_motion<3>(with.cloth.coarse.vertices);
  const auto aligned         = tests::upsampled<3>(with.cloth, current, with.options);
  with.options.path          = Path::general;
  EXPECT_LT(
    (aligned - tests::upsampled<3>(with.cloth, current, with.options)).cwiseAbs().maxCoeff(),
    1e-15);
  EXPECT_GT((aligned - tests::upsampled<3>(with.cloth, current)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(invariant_upsampler_fitted, what_does_not_go_together_is_refused_by_name)
{
  const Fitted with;
  const auto text = [&](const UpsamplerOptions &options)
  {
    return refusal(
      [&]() { Upsampler<2>(with.cloth.cell, with.cloth.coarse, with.cloth.sheet, options); });
  };
  UpsamplerOptions options = with.options;
  options.blend            = Blend::piecewise;
  EXPECT_NE(text(options).find("expected Blend::continuous"), std::string::npos);
  options              = with.options;
  options.second_order = "biot";
  EXPECT_NE(text(options).find("expected one of the two"), std::string::npos);
  options        = with.options;
  options.strain = Strain::linear;
  EXPECT_NE(text(options).find("asked for with the linear strain"), std::string::npos);
  meshes::FittedModes of_another_cell = with.modes;
  of_another_cell.modes.conservativeResize(3, Eigen::NoChange);
  options        = with.options;
  options.fitted = &of_another_cell;
  EXPECT_NE(text(options).find("has 3 rows of fitted modes"), std::string::npos);
}

// The definition, in the frame of the cells of each panel, at the fine vertices away from seams.
TEST(exact_garment, second_order_and_fitted_modes_follow_the_grain)
{
  tests::Garment garment = tests::two_panels();
  const Fitted other;
  const meshes::QuadraticChi modes = cloth_of_second_order().cell.second_order.at("biot").chi;
  ASSERT_EQ(modes.rows(), garment.cell.mesh.n_vertices());
  garment.cell.second_order["biot"].chi = modes;
  UpsamplerOptions quadratic            = of_second_order();
  for (const UpsamplerOptions &options : {quadratic, other.options})
  {
    const auto F = tests::some_stretch<3>();
    const tests::TwoPanels panels;
    const tests::Space fine   = garment.upsampled(tests::affine_motion<3>(panels.flat, F), options);
    const tests::Space affine = tests::affine_motion<3>(tests::flat_points(garment.fine), F);
    int n_compared            = 0;
    double largest            = 0.;
    for (int v = 0; v < garment.fine.n_vertices(); ++v)
    {
      if (garment.fine.seam_distance(v) < garment.fade() || garment.fine.cell_vertex(v) < 0)
        continue;
      const int panel = garment.fine.panel(v);
      const Eigen::Matrix2d panel_turn =
        panel == 0 ? Eigen::Matrix2d::Identity().eval() : tests::turn(tests::TwoPanels::angle);
      const Frame<3> frame =
        tests::frame_by_svd<3>(F * panel_turn.transpose() *
                               garment.fine.grains[static_cast<std::size_t>(panel)].rotation());
      const int image = garment.fine.cell_vertex(v);
      Eigen::VectorXd factors(9);
      if (options.fitted == nullptr)
        factors << frame.strain, meshes::quadratic_factors(frame.strain);
      else
        factors = meshes::FittedResponse(*options.fitted).at(frame.strain).transpose();
      Eigen::Vector2d w = Eigen::Vector2d::Zero(), beside = w;
      for (int k = 0; k < 3; ++k)
        w -= factors(k) * garment.cell.chi.row(image).segment<2>(2 * k).transpose();
      for (int k = 0; k < 6; ++k)
        beside -= factors(3 + k) * modes.row(image).segment<2>(2 * k).transpose();
      const Eigen::RowVector3d expected = affine.row(v) + (frame.lift * (w + beside)).transpose();
      EXPECT_LT((fine.row(v) - expected).norm(), 1e-15);
      largest = std::max(largest, beside.norm());
      ++n_compared;
    }
    EXPECT_GT(n_compared, garment.fine.n_vertices() / 3);
    EXPECT_GT(largest, 1e-7);
  }
}

TEST(invariant_upsampler_second_order, a_cell_that_has_modes_nobody_asks_for_gives_the_same_bits)
{
  const tests::Cloth with = cloth_of_second_order(), without = tests::skewed_cloth();
  const Positions<3> current = tests::wavy_motion<3>(with.coarse.vertices);
  EXPECT_EQ(tests::upsampled<3>(with, current), tests::upsampled<3>(without, current));
  EXPECT_EQ((Upsampler<3>(with.cell, with.coarse, with.sheet).table_bytes()),
            (Upsampler<3>(without.cell, without.coarse, without.sheet).table_bytes()));
}

TEST(invariant_upsampler_second_order, what_is_asked_for_and_not_there_is_refused_by_name)
{
  const tests::Cloth with = cloth_of_second_order(), without = tests::skewed_cloth();
  UpsamplerOptions options = of_second_order();
  const auto text          = [&](const tests::Cloth &cloth)
  { return refusal([&]() { Upsampler<3>(cloth.cell, cloth.coarse, cloth.sheet, options); }); };
  EXPECT_NE(text(without).find("has no quadratic modes under the law `biot`; found none"),
            std::string::npos)
    << text(without);
  options.second_order = "green";
  EXPECT_NE(text(with).find("under the law `green`; found those of biot"), std::string::npos);
  options        = of_second_order();
  options.strain = Strain::linear;
  const std::string of_linear =
    refusal([&]() { Upsampler<2>(with.cell, with.coarse, with.sheet, options); });
  EXPECT_NE(of_linear.find("asked for with the linear strain"), std::string::npos) << of_linear;
  const tests::Garment garment = tests::two_panels();
  const std::string of_garment = refusal(
    [&]() { placed_garment(garment.cell, garment.coarse, garment.fine, of_second_order()); });
  EXPECT_NE(of_garment.find("found none"), std::string::npos) << of_garment;
}
