// SPDX-License-Identifier: MIT
#include "localization/upsampler.h"
#include "localization/upsampler_faults.h"
#include "meshes/plain/errors.h"
#include "tests/localization/localization_cases.h"
#include "tests/meshes/plain/plain_cell.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::localization;
using homespun::tests::refusal;

namespace
{
/// F X + L w, w = −sum of E_a chi_a, from the definitions and the singular values of F.
template <int dim>
Positions<dim> uniform_solution(const tests::Cloth &cloth, const Eigen::Matrix<double, dim, 2> &F,
                                const Lift lift)
{
  const Frame<dim> frame = tests::frame_by_svd<dim>(F);
  const Eigen::Matrix<double, dim, 2> L =
    lift == Lift::rotation ? frame.lift
    : lift == Lift::affine
      ? F
      : Eigen::Matrix<double, dim, 2>(Eigen::Matrix<double, dim, 2>::Identity());
  Positions<dim> expected = tests::affine_motion<dim>(cloth.sheet.mesh.vertices, F);
  for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
  {
    const auto chi = cloth.cell.chi.row(cloth.sheet.cell_vertex(v));
    for (int c = 0; c < 2; ++c)
    {
      const double w =
        -(frame.strain(0) * chi(c) + frame.strain(1) * chi(2 + c) + frame.strain(2) * chi(4 + c));
      expected.row(v) += w * L.col(c).transpose();
    }
  }
  return expected;
}

template <int dim>
double difference_from_uniform_solution(const tests::Cloth &given, const tests::Cloth &used,
                                        const Lift lift, const Path path = Path::automatic)
{
  UpsamplerOptions options;
  options.lift = lift;
  options.path = path;
  const auto F = tests::some_stretch<dim>();
  const auto fine =
    tests::upsampled<dim>(used, tests::affine_motion<dim>(used.coarse.vertices, F), options);
  return (fine - uniform_solution<dim>(given, F, lift)).cwiseAbs().maxCoeff();
}

template <int dim>
std::vector<Positions<dim>> collapsed_motions(const meshes::Points &rest)
{
  std::vector<Positions<dim>> motions;
  Eigen::Matrix<double, dim, 2> F = Eigen::Matrix<double, dim, 2>::Zero();
  motions.push_back(tests::affine_motion<dim>(rest, F)); // a point
  F(0, 0) = 1.;
  motions.push_back(tests::affine_motion<dim>(rest, F)); // a line
  F(1, 1) = -1.;
  motions.push_back(tests::affine_motion<dim>(rest, F)); // mirrored
  F.setIdentity();
  motions.push_back(0.2 * tests::affine_motion<dim>(rest, F)); // compressed
  motions.push_back(tests::wavy_motion<dim>(rest));
  motions.back().row(1) = motions.back().row(0); // two vertices coincident
  motions.push_back(tests::wavy_motion<dim>(rest));
  motions.back()(3, 0) = 1e6;
  return motions;
}
} // namespace

TEST(exact_upsampler, a_uniform_strain_gives_the_affine_motion_and_its_fluctuation)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  for (const Path path : {Path::automatic, Path::general})
    for (const Lift lift : {Lift::rotation, Lift::affine, Lift::identity})
    {
      EXPECT_LT(difference_from_uniform_solution<2>(cloth, cloth, lift, path), 1e-16 * 10.);
      EXPECT_LT(difference_from_uniform_solution<3>(cloth, cloth, lift, path), 1e-16 * 10.);
    }
}

TEST(exact_upsampler, a_uniform_strain_of_any_size_is_up_sampled_exactly)
{
  // Twenty roundings of positions that are up to twenty cell sides away.
  const tests::Cloth cloth = tests::skewed_cloth();
  const double limit       = 400. * 2.2e-16 * std::sqrt(cloth.cell.lattice.area());
  std::vector<Eigen::Matrix<double, 3, 2>> motions(6, Eigen::Matrix<double, 3, 2>::Zero());
  motions[0].topRows<2>() << 0.2, 0., 0., 1.;
  motions[1].topRows<2>() << 1., 0., 0., 1.;
  motions[2].topRows<2>() << 5., 0., 0., 1.;
  motions[3].topRows<2>() << 0.2, 0., 0., 0.2;
  motions[4] << 1., 1., 0., 1., 0.2, -0.1;
  motions[5].topRows<2>() << -1., 0., 0., -1.;
  for (const auto &F : motions)
    EXPECT_LT((tests::upsampled<3>(cloth, tests::affine_motion<3>(cloth.coarse.vertices, F)) -
               uniform_solution<3>(cloth, F, Lift::rotation))
                .rowwise()
                .norm()
                .maxCoeff(),
              limit)
      << F;
}

TEST(exact_upsampler, stripes_stretched_across_follow_the_laminate_exactly)
{
  // Half hard (10), half soft (1): under a strain e across the stripes the soft half takes 20/11 e
  // and the hard half 2/11 e, so chi_22 is a saw tooth with slopes −9/11 and 9/11.
  meshes::HomogenizedCell cell = tests::plain_cell(tests::square_lattice(1.), 4, 4);
  const auto saw               = [](const double y) { return -9. / 11. * (y < 0.5 ? y : 1. - y); };
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    cell.chi(v, 3) = saw(cell.mesh.vertices(v, 1));
  const tests::Cloth cloth(cell, 3, 2);
  const double strain = 0.1;
  const auto fine     = tests::upsampled<2>(
    cloth, Positions<2>(cloth.coarse.vertices * Eigen::Vector2d(1., 1. + strain).asDiagonal()));
  for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
  {
    const double Y = cloth.sheet.mesh.vertices(v, 1), y = Y - std::floor(Y);
    const double soft = std::min(y, 0.5), hard = std::max(y - 0.5, 0.);
    const double expected =
      std::floor(Y) * (1. + strain) + y + strain * (20. / 11. * soft + 2. / 11. * hard);
    EXPECT_NEAR(fine(v, 1), expected, 1e-14);
    EXPECT_NEAR(fine(v, 0), cloth.sheet.mesh.vertices(v, 0), 1e-14);
  }
}

TEST(invariant_upsampler, a_rotation_in_space_turns_the_result)
{
  const tests::Cloth cloth   = tests::skewed_cloth();
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  const auto fine            = tests::upsampled<3>(cloth, current);
  for (const double angle : {0.4, 1.9, 3.1415926535897931})
  {
    const Eigen::Matrix3d R =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
    const auto turned = tests::upsampled<3>(cloth, Positions<3>(current * R.transpose()));
    EXPECT_LT((turned - fine * R.transpose()).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(exact_upsampler, lattice_points_land_on_coarse_vertices_with_the_lattice_anchor_only)
{
  const tests::Cloth cloth   = tests::skewed_cloth();
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  UpsamplerOptions mean;
  mean.anchor          = Anchor::mean;
  const auto anchored  = tests::upsampled<3>(cloth, current),
             meaned    = tests::upsampled<3>(cloth, current, mean);
  int n_lattice_points = 0;
  for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
    for (int k = 0; k < cloth.coarse.n_vertices(); ++k)
      if ((cloth.sheet.mesh.vertices.row(v) - cloth.coarse.vertices.row(k)).norm() < 1e-12)
      {
        ++n_lattice_points;
        EXPECT_LT((anchored.row(v) - current.row(k)).norm(), 1e-16);
        EXPECT_GT((meaned.row(v) - current.row(k)).norm(), 1e-7);
      }
  EXPECT_EQ(n_lattice_points, cloth.coarse.n_vertices());
}

TEST(exact_upsampler, without_modes_or_with_modes_of_zero_the_coarse_motion_is_interpolated)
{
  tests::Cloth cloth         = tests::skewed_cloth();
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  UpsamplerOptions baseline;
  baseline.microscopic = false;
  const auto affine    = tests::upsampled<3>(cloth, current, baseline);
  EXPECT_GT((affine - tests::upsampled<3>(cloth, current)).cwiseAbs().maxCoeff(), 1e-6);
  cloth.cell.chi.setZero();
  EXPECT_LT((affine - tests::upsampled<3>(cloth, current)).cwiseAbs().maxCoeff(), 1e-17);
}

TEST(exact_upsampler, a_coarse_mesh_of_other_triangles_still_reproduces_a_uniform_strain)
{
  tests::Cloth cloth            = tests::skewed_cloth();
  const meshes::Lattice lattice = cloth.sheet.lattice;
  meshes::Lattice whole;
  whole.vectors.row(0) = cloth.sheet.n1 * lattice.vectors.row(0);
  whole.vectors.row(1) = cloth.sheet.n2 * lattice.vectors.row(1);
  cloth.coarse         = tests::parallelogram(whole, 5, 7);
  tests::shake(cloth.coarse, whole, 1e-3);
  ASSERT_FALSE((Upsampler<2, double>(cloth.cell, cloth.coarse, cloth.sheet).is_aligned()));
  EXPECT_LT(difference_from_uniform_solution<2>(cloth, cloth, Lift::rotation), 1e-15);
  EXPECT_LT(difference_from_uniform_solution<3>(cloth, cloth, Lift::affine), 1e-15);
}

TEST(exact_upsampler, the_linear_option_is_linear_in_the_displacement)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  UpsamplerOptions linear;
  linear.strain = Strain::linear;
  const Positions<2> displacement =
    tests::wavy_motion<2>(cloth.coarse.vertices) - cloth.coarse.vertices;
  const auto at = [&](const double t)
  {
    return tests::upsampled<2>(cloth, Positions<2>(cloth.coarse.vertices + t * displacement),
                               linear);
  };
  const auto rest = at(0.), once = at(1.), triple = at(3.);
  EXPECT_LT((rest - cloth.sheet.mesh.vertices).cwiseAbs().maxCoeff(), 1e-16);
  EXPECT_LT(((triple - rest) - 3. * (once - rest)).cwiseAbs().maxCoeff(), 1e-16);
}

TEST(order_upsampler, linear_and_biot_differ_by_the_square_of_the_displacement)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  UpsamplerOptions linear;
  linear.strain = Strain::linear;
  const Positions<2> displacement =
    tests::wavy_motion<2>(cloth.coarse.vertices) - cloth.coarse.vertices;
  std::vector<double> ratios;
  double before = 0.;
  for (double t = 0.1; t > 0.005; t *= 0.5)
  {
    const Positions<2> current = cloth.coarse.vertices + t * displacement;
    const double now =
      (tests::upsampled<2>(cloth, current, linear) - tests::upsampled<2>(cloth, current)).norm();
    if (before > 0.)
      ratios.push_back(std::log2(before / now));
    before = now;
  }
  for (const double order : ratios)
    EXPECT_NEAR(order, 2., 0.1);
}

TEST(bound_upsampler, float_and_double_agree_to_the_digits_of_a_float)
{
  const tests::Cloth cloth   = tests::skewed_cloth();
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  for (const Path path : {Path::automatic, Path::general})
  {
    UpsamplerOptions options;
    options.path = path;
    const Upsampler<3, float> upsampler(cloth.cell, cloth.coarse, cloth.sheet, options);
    Upsampler<3, float>::Fine fine;
    upsampler.upsample(current, fine);
    const auto exact = tests::upsampled<3>(cloth, current, options);
    EXPECT_LT((fine.cast<double>() - exact).cwiseAbs().maxCoeff(),
              4. * 6e-8 * current.cwiseAbs().maxCoeff());
  }
}

TEST(bound_upsampler, collapsed_mirrored_and_compressed_triangles_give_finite_positions)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  for (const Lift lift : {Lift::rotation, Lift::affine})
  {
    UpsamplerOptions options;
    options.lift = lift;
    for (const auto &motion : collapsed_motions<2>(cloth.coarse.vertices))
      EXPECT_TRUE(tests::upsampled<2>(cloth, motion, options).allFinite());
    for (const auto &motion : collapsed_motions<3>(cloth.coarse.vertices))
      EXPECT_TRUE(tests::upsampled<3>(cloth, motion, options).allFinite());
  }
}

TEST(bound_upsampler, a_second_frame_keeps_the_output_in_its_place_and_writes_every_vertex)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  const Upsampler<3, float> upsampler(cloth.cell, cloth.coarse, cloth.sheet);
  Upsampler<3, float>::Fine fine;
  upsampler.upsample(tests::wavy_motion<3>(cloth.coarse.vertices), fine);
  const float *const data               = fine.data();
  const Upsampler<3, float>::Fine first = fine;
  fine.setConstant(std::numeric_limits<float>::quiet_NaN());
  upsampler.upsample(tests::wavy_motion<3>(cloth.coarse.vertices), fine);
  EXPECT_EQ(fine.data(), data);
  EXPECT_EQ(fine, first);
}

TEST(tripwire_upsampler, a_wrong_sign_a_transposed_chi_and_a_lost_factor_of_two_are_noticed)
{
  const tests::Cloth good = tests::skewed_cloth();
  tests::Cloth bad        = good;
  bad.cell.chi            = -good.cell.chi;
  EXPECT_GT(difference_from_uniform_solution<2>(good, bad, Lift::rotation), 1e-6);
  bad = good;
  for (int a = 0; a < 3; ++a)
    bad.cell.chi.middleCols<2>(2 * a) = good.cell.chi.middleCols<2>(2 * a).rowwise().reverse();
  EXPECT_GT(difference_from_uniform_solution<2>(good, bad, Lift::rotation), 1e-6);
  bad = good;
  for (int k = 0; k < 6; ++k) // stored as component, load instead of load, component
    bad.cell.chi.col(k) = good.cell.chi.col(2 * (k % 3) + k / 3);
  EXPECT_GT(difference_from_uniform_solution<3>(good, bad, Lift::rotation), 1e-6);
  bad = good;
  bad.cell.chi.rightCols<2>() *= 0.5;
  EXPECT_GT(difference_from_uniform_solution<3>(good, bad, Lift::rotation), 1e-6);
}

TEST(tripwire_upsampler, faults_are_named)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  const auto expect        = [](const std::string &text, const std::string &part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  const auto make = [](const tests::Cloth &given, const UpsamplerOptions &options = {})
  { Upsampler<3, float>(given.cell, given.coarse, given.sheet, options); };

  tests::Cloth bad = cloth;
  bad.coarse       = meshes::coarse_sheet(cloth.sheet.origin, cloth.sheet.lattice.vectors, 3, 3);
  expect(refusal([&] { make(bad); }), "lies in no coarse triangle");
  expect(refusal([&] { make(bad); }), "fine vertex ");
  bad = cloth;
  bad.cell.lattice.vectors(0, 0) *= 1.01;
  expect(refusal([&] { make(bad); }), "lattice vectors differ");
  bad = cloth;
  bad.cell.chi.conservativeResize(5, 6);
  expect(refusal([&] { make(bad); }), "has 5 rows of characteristic displacements; expected 56");
  bad                = cloth;
  bad.cell.chi(3, 2) = std::numeric_limits<double>::quiet_NaN();
  expect(refusal([&] { make(bad); }), "not all finite");
  bad                      = cloth;
  bad.sheet.cell_vertex(9) = 1000;
  expect(refusal([&] { make(bad); }), "names cell vertex 1000");
  bad                        = cloth;
  bad.coarse.vertices.row(5) = bad.coarse.vertices.row(6);
  expect(refusal([&] { make(bad); }), "coarse mesh");
  UpsamplerOptions linear;
  linear.strain = Strain::linear;
  expect(refusal([&] { make(cloth, linear); }), "in the plane only");

  const Upsampler<3, float> upsampler(cloth.cell, cloth.coarse, cloth.sheet);
  Upsampler<3, float>::Fine fine;
  Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  current(7, 1)        = std::numeric_limits<double>::quiet_NaN();
  expect(refusal([&] { upsampler.upsample(current, fine); }),
         "coarse vertex 7: its position is not finite");
  expect(refusal([&] { upsampler.upsample(Positions<3>::Zero(4, 3), fine); }),
         "have 4 rows; expected 20");
}

TEST(tripwire_upsampler, a_sheet_of_another_mesh_of_the_same_lattice_is_named)
{
  const meshes::Lattice lattice         = tests::skewed_lattice();
  const meshes::HomogenizedCell cell    = tests::plain_cell(lattice, 6, 6),
                                other   = tests::plain_cell(lattice, 5, 6);
  const meshes::Sheet sheet             = meshes::tile(other.mesh, lattice, 2, 2);
  const std::vector<std::string> faults = sheet_faults(cell, sheet);
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults[0].find("it was tiled from another cell"), std::string::npos);
  EXPECT_TRUE(sheet_faults(other, sheet).empty());
}
