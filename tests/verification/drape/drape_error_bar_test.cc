// SPDX-License-Identifier: MIT
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/drape/drape_error_bar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A sheet of one cell, pulled during four hundredths of a second.
DrapeErrorBar bar_of(const double time_step, const TimeIntegration integration)
{
  Scene scene          = read_scene(std::string(CELLS) + "../scenes/pull.prm");
  scene.time_step      = time_step;
  scene.frame_interval = 0.02;
  scene.duration       = 0.04;
  scene.integration    = integration;
  const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "layered.prm");
  const homogenization::Homogenization result =
    homogenization::homogenize(cell, {}, MPI_COMM_WORLD);
  const DrapedCell draped(scene, cell, homogenization::homogenized_cell(cell, result, ""),
                          Law::biot);
  return drape_error_bar(draped, Law::biot, 1, DrapeSchedule(scene), MPI_COMM_WORLD,
                         [](const int) {});
}
} // namespace

TEST(order_drape_error_bar, the_part_of_the_time_step_is_of_first_order)
{
  const DrapeErrorBar coarse = bar_of(0.01, TimeIntegration::implicit),
                      middle = bar_of(0.005, TimeIntegration::implicit),
                      fine   = bar_of(0.0025, TimeIntegration::implicit);
  ASSERT_EQ(coarse.halved_step.size(), 3u);
  ASSERT_EQ(fine.halved_step.size(), 3u);
  const double order = std::log(coarse.halved_step[2] / fine.halved_step[2]) / std::log(4.);
  EXPECT_NEAR(order, 1., 0.2);
  // The bar holds what three halvings change together.
  EXPECT_GT(coarse.of_time_step_at(2, coarse.fluctuation[2]),
            coarse.halved_step[2] + middle.halved_step[2] + fine.halved_step[2]);
  const double of_mesh = fine.of_mesh_at(2, fine.fluctuation[2]);
  EXPECT_EQ(fine.meshes[2].safety(), 1.25);
  EXPECT_GT(of_mesh, 0.);
  EXPECT_LT(of_mesh, fine.fluctuation[2]);
  // What it is carried over with.
  EXPECT_DOUBLE_EQ(fine.of_mesh_at(2, 3. * fine.fluctuation[2]), 3. * of_mesh);
  EXPECT_TRUE(std::isnan(fine.of_mesh_at(3, 1.)));
}

TEST(exact_drape_error_bar, equilibria_have_no_time_step)
{
  const DrapeErrorBar bar = bar_of(0.01, TimeIntegration::equilibria);
  ASSERT_EQ(bar.halved_step.size(), 3u);
  EXPECT_EQ(bar.of_time_step_at(2, bar.fluctuation[2]), 0.);
  EXPECT_GT(bar.of_mesh_at(2, bar.fluctuation[2]), 0.);
}

TEST(bound_drape_error_bar, a_frame_in_which_coarse_and_fine_cloth_cross_keeps_its_bar)
{
  DrapeErrorBar bar;
  bar.order       = 1.;
  bar.meshes      = {{0.2, 0.3, 0.1, true}, {2e-3, 3e-3, 1e-3, true}};
  bar.halved_step = {0.1, 1e-3};
  bar.fluctuation = {1., 0.01};
  EXPECT_GE(bar.of_time_step_at(1, 1.), 0.25);
  EXPECT_EQ(bar.of_time_step_at(1, 1.), bar.of_time_step_at(0, 1.));
  EXPECT_EQ(bar.of_mesh_at(1, 2.), 2. * bar.of_mesh_at(0, 1.));
}
