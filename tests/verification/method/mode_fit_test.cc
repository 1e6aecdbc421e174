// SPDX-License-Identifier: MIT
// Modes fitted over a box of strains, against equilibria of the cell that the fit has not seen.
#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/refusal.h"
#include "verification/method/mode_fit.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
struct FittedCell
{
  FittedCell(const homogenization::UnitCell &cell, const Law law, const StrainBox &box)
      : homogenized(homogenization::homogenized_cell(cell, tests::solved(cell), "test"))
      , nonlinear(homogenized, cell.stiffness_of_phase(), law)
      , fit(fit_modes(nonlinear, homogenized, box))
  {
  }

  /// Mean error of w over mean w, over the vertices, with or without the modes.
  double left_at(const Eigen::Vector3d &strain, const bool with_modes) const
  {
    const meshes::Points w = nonlinear.solve(strain).fluctuation;
    const auto response    = meshes::FittedResponse(fit.modes).at(strain);
    Eigen::Vector3d of_chi = strain;
    if (with_modes)
      of_chi = response.head<3>();
    double miss = 0.;
    for (int v = 0; v < w.rows(); ++v)
    {
      Eigen::RowVector2d of = w.row(v);
      for (int a = 0; a < 3; ++a)
        of += of_chi(a) *
              (homogenized.chi.row(v) - homogenized.chi.row(homogenized.anchor)).segment<2>(2 * a);
      for (int k = 0; with_modes && k < meshes::FittedModes::n_modes; ++k)
        of += response(3 + k) * fit.modes.modes.row(v).segment<2>(2 * k);
      miss += of.norm();
    }
    return miss / w.rowwise().norm().sum();
  }

  meshes::HomogenizedCell homogenized;
  const NonlinearCell nonlinear;
  const ModeFit fit;
};
} // namespace

TEST(exact_mode_fit, a_cell_of_one_phase_has_no_modes)
{
  const FittedCell even(tests::cell_of(tests::square_lattice(0.01), 4, 4,
                                       {tests::soft_and_hard()[0]},
                                       [](double, double) { return 0; }),
                        Law::biot, box_up_to(0.1, Law::biot));
  EXPECT_LT(even.fit.modes.modes.cwiseAbs().maxCoeff(), 1e-12 * 0.01);
}

// The functions vanish at rest with their first derivatives: what is fitted at large strains leaves
// the first order to chi.
TEST(order_mode_fit, at_rest_the_modes_are_of_second_order)
{
  const FittedCell chevron(homogenization::read_unit_cell(CELLS "chevron.prm"), Law::biot,
                           box_up_to(0.1, Law::biot));
  const Eigen::Vector3d strain(0.6, -0.3, 0.5);
  double last = 0.;
  for (const double size : {1e-3, 1e-4, 1e-5})
  {
    const double now = meshes::FittedResponse(chevron.fit.modes).at(size * strain).tail<6>().norm();
    if (last > 0.)
    {
      EXPECT_NEAR(std::log10(last / now), 2., 0.02) << size;
    }
    last = now;
  }
}

// Held-out strains: chevron at large strain, a weave where its modes at rest reach no further than
// a fifth of a per cent. What chi leaves there is what these gain is measured by.
TEST(bound_mode_fit, strains_that_were_not_fitted_are_a_tenth_as_far_as_by_chi)
{
  const FittedCell chevron(homogenization::read_unit_cell(CELLS "chevron.prm"), Law::biot,
                           box_up_to(0.2, Law::biot)),
    weave(homogenization::read_unit_cell(CELLS "plain-weave-straight.prm"), Law::yarn,
          box_up_to(0.05, Law::yarn));
  for (const FittedCell *cell : {&chevron, &weave})
  {
    EXPECT_LT(cell->fit.left, 0.1 * cell->fit.left_by_chi);
    EXPECT_GT(cell->fit.left_by_chi, 0.05);
  }
  for (const auto &[cell, strain] : {std::pair(&chevron, Eigen::Vector3d(0.15, 0.05, -0.1)),
                                     std::pair(&weave, Eigen::Vector3d(0.02, 0.015, 0.01))})
  {
    EXPECT_LT(cell->left_at(strain, true), 0.1 * cell->left_at(strain, false));
    EXPECT_GT(cell->left_at(strain, false), 0.02);
  }
}

// Sheared far and hardly stretched, which a box that shrinks as a whole never sees.
TEST(bound_mode_fit, a_weave_that_is_sheared_is_half_as_far_as_by_chi)
{
  const FittedCell weave(homogenization::read_unit_cell(CELLS "plain-weave-straight.prm"),
                         Law::yarn, box_up_to(0.05, Law::yarn));
  for (const double shear : {0.02, 0.05})
  {
    const Eigen::Vector3d strain(0., 0.25 * shear * shear, shear);
    EXPECT_LT(weave.left_at(strain, true), 0.5 * weave.left_at(strain, false)) << shear;
    EXPECT_GT(weave.left_at(strain, false), 0.05) << shear;
  }
}

// The effective strain says how much of each chi there is: modes hold nothing of it.
TEST(exact_mode_fit, modes_are_orthogonal_to_chi_in_the_mean_over_the_cell)
{
  const FittedCell chevron(homogenization::read_unit_cell(CELLS "chevron.prm"), Law::biot,
                           box_up_to(0.1, Law::biot));
  const meshes::TriangleMesh &mesh = chevron.homogenized.mesh;
  const Eigen::VectorXd areas      = meshes::signed_areas(mesh);
  Eigen::VectorXd shares           = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      shares(mesh.triangles(t, k)) += areas(t) / (3. * areas.sum());
  const auto mean_product = [&](const auto &left, const auto &right)
  {
    double product            = 0.;
    Eigen::RowVector2d mean_l = Eigen::RowVector2d::Zero(), mean_r = mean_l;
    for (int v = 0; v < mesh.n_vertices(); ++v)
    {
      product += shares(v) * left(v).dot(right(v));
      mean_l += shares(v) * left(v);
      mean_r += shares(v) * right(v);
    }
    return product - mean_l.dot(mean_r);
  };
  for (int k = 0; k < meshes::FittedModes::n_modes; ++k)
    for (int a = 0; a < 3; ++a)
    {
      const auto mode = [&](const int v)
      { return Eigen::RowVector2d(chevron.fit.modes.modes.row(v).segment<2>(2 * k)); };
      const auto chi = [&](const int v)
      { return Eigen::RowVector2d(chevron.homogenized.chi.row(v).segment<2>(2 * a)); };
      EXPECT_NEAR(mean_product(mode, chi), 0.,
                  1e-9 * std::sqrt(mean_product(mode, mode) * mean_product(chi, chi)))
        << k << a;
    }
}

TEST(invariant_mode_fit, triangles_outside_of_the_box_are_counted)
{
  meshes::FittedModes modes;
  modes.low  = Eigen::Vector3d(-0.01, -0.01, -0.02);
  modes.high = Eigen::Vector3d(0.05, 0.05, 0.02);
  const meshes::TriangleMesh rest =
    meshes::coarse_sheet({0., 0.}, 0.01 * Eigen::Matrix2d::Identity(), 3, 2);
  meshes::Points moved = rest.vertices;
  EXPECT_EQ(n_outside(modes, rest, moved), 0);
  moved.row(0) -= Eigen::RowVector2d(0.001, 0.); // 10 % of a side that two triangles share
  EXPECT_EQ(n_outside(modes, rest, moved), 2);
}
