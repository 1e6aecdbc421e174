// SPDX-License-Identifier: MIT
// Brackets on the bending stiffness D^H, held against closed forms of plates, a plate assembled
// without the analogy, and what a null Lagrangian, turns and shifts must do.
#include "homogenization/bracket/clough_tocher.h"
#include "tests/homogenization/bracket/bending_cells.h"
#include "tests/homogenization/cell/cells.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;
using tests::bent;
using tests::is_ordered;
using tests::odd_pattern;
using tests::plate;
using tests::relative_difference;
using tests::yarn;

namespace
{
/// A plate of layers along axis 1, stacked along axis 2: kappa11 and 2 kappa12 are those of the
/// plate, M22 is the same in all. With a, b of 11, 12:
///   D_ab = <D_ab − D_a2 D_2b / D22> + <D_a2 / D22> <D_2b / D22> D22^H,  D22^H = 1/<1/D22>.
Eigen::Matrix3d laminated_plate(const std::vector<Eigen::Matrix3d> &layers,
                                const std::vector<double> &fractions)
{
  Eigen::Matrix3d rest       = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean_ratio = Eigen::Vector3d::Zero();
  double mean_inverse        = 0.;
  for (std::size_t k = 0; k < layers.size(); ++k)
  {
    const Eigen::Vector3d to_22 = layers[k].col(1);
    const double D22            = layers[k](1, 1);
    rest += fractions[k] * (layers[k] - to_22 * to_22.transpose() / D22);
    mean_ratio += fractions[k] * to_22 / D22;
    mean_inverse += fractions[k] / D22;
  }
  return rest + mean_ratio * mean_ratio.transpose() / mean_inverse;
}

tests::BracketCell layered(const std::vector<Eigen::Matrix3d> &layers, const double side = 0.01)
{
  return tests::bracket_cell(tests::square_lattice(side), 3, 8, layers,
                             [](double, double f2) { return f2 < 0.25  ? 0
                                                            : f2 < 0.5 ? 1
                                                                       : 2; });
}

tests::BracketCell turned(tests::BracketCell cell, const double angle)
{
  const Eigen::Matrix3d T = stiffness_rotation(angle);
  Eigen::Matrix2d turn;
  turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  cell.mesh.vertices *= turn;
  cell.lattice.vectors *= turn;
  for (Eigen::Matrix3d &c : cell.stiffness)
    c = (T * c * T.transpose()).eval();
  return cell;
}

tests::BracketCell odd_cell(const std::vector<Eigen::Matrix3d> &stiffness, const double to_1 = 0.,
                            const double to_2 = 0.)
{
  return tests::bracket_cell(
    tests::skewed_lattice(), 8, 8, stiffness,
    [=](double f1, double f2)
    { return odd_pattern(std::fmod(f1 + to_1, 1.), std::fmod(f2 + to_2, 1.)); });
}

const std::vector<Eigen::Matrix3d> &yarn_in_film()
{
  static const std::vector<Eigen::Matrix3d> phases = {plate(1., 0.3, 0.5), yarn(25., 0.8)};
  return phases;
}
} // namespace

TEST(exact_bending_bracket, a_homogeneous_sheet_has_the_stiffness_of_its_phase_and_bends_evenly)
{
  for (const Eigen::Matrix3d &D : {plate(1e6, 0.3, 5e-4), yarn(35., 1e-3)})
    for (const unsigned order : {1u, 2u})
    {
      const BendingBracket b = bent(
        tests::bracket_cell(tests::skewed_lattice(), 4, 6, {D}, [](double, double) { return 0; }),
        order);
      EXPECT_LT(relative_difference(b.stiffness, D), 1e-13);
      EXPECT_TRUE(is_ordered(b.lower, D) && is_ordered(D, b.upper));
      EXPECT_LT(b.width, 1e-11);
      // In parts of the area of the cell.
      EXPECT_LT(b.deflection.cwiseAbs().maxCoeff(), 1e-13 * tests::skewed_lattice().area());
    }
  // E t^3 / (12 (1 − nu^2)).
  EXPECT_NEAR(plate(1e6, 0.3, 5e-4)(0, 0), 1e6 * 1.25e-10 / 12. / 0.91, 1e-19);
}

TEST(exact_bending_bracket, laminates_bend_by_their_closed_form_at_any_angle)
{
  const std::vector<double> parts                           = {0.25, 0.25, 0.5};
  const std::vector<std::vector<Eigen::Matrix3d>> laminates = {
    {plate(1., 0.3, 1.), plate(10., 0.3, 1.), plate(3., -0.2, 1.5)},
    {yarn(30., 1.), yarn(-55., 0.8), plate(3., 0.1, 1.2)}};
  for (const auto &layers : laminates)
  {
    const Eigen::Matrix3d upright = laminated_plate(layers, parts);
    for (const double degrees : {0., 90., 30., -63.})
    {
      const double angle          = degrees * M_PI / 180.;
      const Eigen::Matrix3d T     = stiffness_rotation(angle);
      const Eigen::Matrix3d exact = T * upright * T.transpose();
      for (const unsigned order : {1u, 2u})
      {
        const BendingBracket b = bent(turned(layered(layers), angle), order);
        EXPECT_LT(relative_difference(b.lower, exact), 1e-9) << degrees;
        EXPECT_LT(relative_difference(b.upper, exact), 1e-9) << degrees;
        EXPECT_TRUE(is_ordered(b.lower, exact) && is_ordered(exact, b.upper)) << degrees;
      }
    }
  }
  // Of isotropic layers the twist is the arithmetic mean, where C66 is the harmonic one.
  const auto &layers     = laminates[0];
  const BendingBracket b = bent(layered(layers));
  const double mean      = 0.25 * layers[0](2, 2) + 0.25 * layers[1](2, 2) + 0.5 * layers[2](2, 2);
  EXPECT_NEAR(b.lower(2, 2), mean, 1e-9 * mean);
  EXPECT_NEAR(b.upper(2, 2), mean, 1e-9 * mean);
  // The other laminate is off its axes: D16 and D26 are not zero.
  const Eigen::Matrix3d off_axis = laminated_plate(laminates[1], parts);
  EXPECT_GT(std::abs(off_axis(0, 2)), 0.01 * off_axis(0, 0));
  EXPECT_GT(std::abs(off_axis(1, 2)), 0.01 * off_axis(0, 0));
}

TEST(exact_bending_bracket, modes_of_a_laminate_are_those_of_the_closed_form)
{
  // kappa22 in layer k is D22^H (K22 + <D12/D22> K11)/D22 − D12/D22 K11: the second difference of w
  // over three vertices of a layer of equal height gives kappa22 − K22 there.
  const std::vector<Eigen::Matrix3d> layers = {plate(1., 0.3, 1.), plate(10., 0.2, 1.),
                                               plate(3., 0.1, 1.)};
  const std::vector<double> parts           = {0.25, 0.25, 0.5};
  const tests::BracketCell cell             = layered(layers, 1.);
  const BendingBracket b                    = bent(cell);
  const Eigen::Matrix3d D                   = laminated_plate(layers, parts);
  const auto row_of = [](const int j) { return 4 * j; }; // vertices (0, j) of 4 x 9
  ASSERT_NEAR(cell.mesh.vertices(row_of(5), 1), 0.625, 1e-12);
  const double h      = 0.125;
  const int middles[] = {1, 3, 6};
  for (int k = 0; k < 3; ++k)
    for (int load = 0; load < 3; ++load)
    {
      const auto w         = [&](const int j) { return b.deflection(row_of(j), load); };
      const double kappa22 = (w(middles[k] + 1) - 2. * w(middles[k]) + w(middles[k] - 1)) / (h * h);
      const Eigen::Matrix3d &its = layers[static_cast<std::size_t>(k)];
      const Eigen::Vector3d K    = Eigen::Vector3d::Unit(load);
      // M22 is that of the plate.
      const double exact =
        (D.row(1).dot(K) - its(1, 0) * K(0) - its(1, 2) * K(2)) / its(1, 1) - K(1);
      EXPECT_NEAR(kappa22, exact, 1e-9) << k << load;
    }
}

TEST(exact_bending_bracket, a_null_lagrangian_adds_itself)
{
  // c (kappa11 kappa22 − kappa12^2) integrates to that of the mean curvature.
  const double c       = 0.002;
  Eigen::Matrix3d null = Eigen::Matrix3d::Zero();
  null(0, 1) = null(1, 0) = c;
  null(2, 2)              = -0.5 * c;
  std::vector<Eigen::Matrix3d> shifted;
  for (const Eigen::Matrix3d &D : yarn_in_film())
    shifted.emplace_back(D + null);
  for (const unsigned order : {1u, 2u})
  {
    const BendingBracket before = bent(odd_cell(yarn_in_film()), order),
                         after  = bent(odd_cell(shifted), order);
    ASSERT_GT(null.cwiseAbs().maxCoeff(), 1e-2 * before.stiffness.cwiseAbs().maxCoeff());
    EXPECT_LT(relative_difference(after.stiffness, before.stiffness + null), 1e-9);
    EXPECT_TRUE(is_ordered(before.lower + null, after.upper));
    EXPECT_TRUE(is_ordered(after.lower, before.upper + null));
  }
}

TEST(invariant_bending_bracket,
     turned_shifted_doubled_cells_and_millimetres_have_the_same_stiffness)
{
  const tests::BracketCell cell = odd_cell(yarn_in_film());
  const BendingBracket before   = bent(cell);
  const auto same               = [&](const BendingBracket &b, const Eigen::Matrix3d &T)
  {
    EXPECT_LT(relative_difference(b.lower, T * before.lower * T.transpose()), 1e-9);
    EXPECT_LT(relative_difference(b.upper, T * before.upper * T.transpose()), 1e-9);
    EXPECT_NEAR(b.width, before.width, 1e-9);
  };
  const Eigen::Matrix3d none = Eigen::Matrix3d::Identity();
  for (const double angle : {0.5 * M_PI, 0.7})
    same(bent(turned(cell, angle)), stiffness_rotation(angle));
  same(bent(odd_cell(yarn_in_film(), 0.375, 0.75)), none);
  tests::BracketCell in_millimetres = cell;
  in_millimetres.mesh.vertices *= 1e-3;
  in_millimetres.lattice.vectors *= 1e-3;
  const BendingBracket small = bent(in_millimetres);
  same(small, none);
  EXPECT_LT((1e6 * small.deflection - before.deflection).cwiseAbs().maxCoeff(),
            1e-9 * before.deflection.cwiseAbs().maxCoeff());
  meshes::Lattice twice = cell.lattice;
  twice.vectors *= 2.;
  same(bent(tests::bracket_cell(twice, 16, 16, yarn_in_film(),
                                [](double f1, double f2) {
                                  return odd_pattern(std::fmod(2. * f1, 1.),
                                                     std::fmod(2. * f2, 1.));
                                })),
       none);
}

namespace
{
/// The upper side without any analogy: ½ (K + kappa(w)).D.(K + kappa(w)) over Clough-Tocher
/// triangles with D itself, on a square lattice without holes, in dense matrices.
Eigen::Matrix3d plate_written_directly(const tests::BracketCell &cell)
{
  const TorusMesh mesh = glued(cell.mesh, cell.lattice);
  const int n          = 3 * mesh.n_vertices + mesh.n_edges();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n), F = Eigen::MatrixXd::Zero(n, 3);
  Eigen::Matrix3d voigt = Eigen::Matrix3d::Zero();
  for (const TorusTriangle &triangle : mesh.triangles)
  {
    const auto shape  = triangle.shape(mesh.edges);
    const double area = 0.5 * (shape[1](0) * shape[2](1) - shape[1](1) * shape[2](0));
    std::array<Eigen::Vector2d, 3> normals;
    std::array<int, 12> dofs;
    for (int k = 0; k < 3; ++k)
    {
      const auto e = static_cast<std::size_t>(triangle.edges[static_cast<std::size_t>(k)]);
      const Eigen::Vector2d along          = mesh.edges[e].vector;
      normals[static_cast<std::size_t>(k)] = Eigen::Vector2d(along(1), -along(0)) / along.norm();
      for (int d = 0; d < 3; ++d)
        dofs[static_cast<std::size_t>(3 * k + d)] =
          3 * triangle.vertices[static_cast<std::size_t>(k)] + d;
      dofs[static_cast<std::size_t>(9 + k)] = 3 * mesh.n_vertices + static_cast<int>(e);
    }
    const CloughTocher element(shape, normals);
    const Eigen::Matrix3d &D = cell.stiffness[static_cast<std::size_t>(triangle.material)];
    voigt += area * D;
    const Eigen::Vector3d middles[3] = {{0.5, 0.5, 0.}, {0., 0.5, 0.5}, {0.5, 0., 0.5}};
    for (int piece = 0; piece < 3; ++piece)
      for (const Eigen::Vector3d &point : middles)
      {
        Eigen::Matrix<double, 3, 12> kappa = element.second_derivatives(piece, point);
        kappa.row(2) *= 2.;
        const Eigen::Matrix<double, 12, 12> K = area / 9. * kappa.transpose() * D * kappa;
        const Eigen::Matrix<double, 12, 3> f  = area / 9. * kappa.transpose() * D;
        for (std::size_t i = 0; i < 12; ++i)
        {
          F.row(dofs[i]) -= f.row(static_cast<Eigen::Index>(i));
          for (std::size_t j = 0; j < 12; ++j)
            A(dofs[i], dofs[j]) += K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        }
      }
  }
  const int m             = n - 1; // without the first value, the constant
  const Eigen::MatrixXd w = A.bottomRightCorner(m, m).ldlt().solve(F.bottomRows(m));
  return (voigt - w.transpose() * F.bottomRows(m)) / mesh.lattice.area();
}
} // namespace

TEST(bound_bending_bracket, the_plate_written_directly_is_the_upper_side_and_lies_inside)
{
  const tests::BracketCell cell =
    tests::bracket_cell(tests::square_lattice(1.), 8, 8, yarn_in_film(), odd_pattern);
  const Eigen::Matrix3d direct = plate_written_directly(cell);
  const BendingBracket b       = bent(cell);
  EXPECT_LT(relative_difference(b.stiffness, direct), 1e-10);
  EXPECT_TRUE(is_ordered(b.lower, direct));
  EXPECT_TRUE(is_ordered(direct, b.upper, 1e-10));
  EXPECT_LT(b.width, 0.2); // not inside because it is vast
  // Energies of the curvatures of each phase are the stiffness.
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < cell.stiffness.size(); ++k)
    sum += energies_of(cell.stiffness[k], b.curvature_products[k]);
  EXPECT_LT(relative_difference(sum, b.stiffness), 1e-12);
}

TEST(bound_bending_bracket, sides_keep_their_order_at_any_contrast_and_close_by_adaptivity)
{
  for (const double contrast : {1., 30., 1e4, 1e6})
  {
    const BendingBracket b = bent(odd_cell(tests::contrasting(contrast)));
    EXPECT_TRUE(is_ordered(b.lower, b.upper)) << contrast;
    EXPECT_LT(b.round_off, 1e-7) << contrast;
  }
  const tests::BracketCell cell = odd_cell(yarn_in_film());
  const BendingBracket coarse   = bent(cell);
  AdaptiveOptions options;
  options.tolerance                   = 2e-4;
  const AdaptiveBendingBracket narrow = adaptive_bending_bracket(
    glued(cell.mesh, cell.lattice), cell.stiffness, options, [](const BendingBracket &) {});
  EXPECT_EQ(narrow.ending, AdaptiveEnd::tolerance);
  EXPECT_LE(narrow.bracket.width, 2e-4);
  EXPECT_TRUE(is_ordered(coarse.lower, narrow.bracket.lower));
  EXPECT_TRUE(is_ordered(narrow.bracket.upper, coarse.upper));
}
