// SPDX-License-Identifier: MIT
// Up-sampling with quadratic modes.
#include "localization/upsampler.h"
#include "tests/localization/garment_cases.h"
#include "tests/localization/localization_cases.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

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
      const int image = cloth.sheet.cell_vertex(v);
      const Eigen::Matrix<double, dim, 1> expected =
        fine_position<dim>(frames, t, weights, chi.row(image), current, quadratic.row(image));
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
  const std::string of_garment =
    refusal([&]() { Upsampler<3>(garment.cell, garment.coarse, garment.fine, of_second_order()); });
  EXPECT_NE(of_garment.find("of a garment"), std::string::npos) << of_garment;
}
