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
/// Four hundredths of a second of a scene.
Scene short_scene(const double time_step)
{
  Scene scene          = read_scene(std::string(CELLS) + "../scenes/pull.prm");
  scene.time_step      = time_step;
  scene.frame_interval = 0.02;
  scene.duration       = 0.04;
  return scene;
}

DrapedCell draped_in(const Scene &scene)
{
  const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "layered.prm");
  const homogenization::Homogenization result =
    homogenization::homogenize(cell, {}, MPI_COMM_WORLD);
  return {scene, cell, homogenization::homogenized_cell(cell, result, ""), Law::biot};
}

/// Measured on one cell.
DrapeErrorBar bar_of(const Scene &scene)
{
  return drape_error_bar(draped_in(scene), Law::biot, 1, DrapeSchedule(scene), MPI_COMM_WORLD,
                         [](const int) {});
}

/// Of a sheet that is pulled.
DrapeErrorBar bar_of(const double time_step, const TimeIntegration integration)
{
  Scene scene       = short_scene(time_step);
  scene.integration = integration;
  return bar_of(scene);
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

TEST(exact_drape_error_bar, what_cloths_share_of_the_time_step_is_that_of_the_whole_sheet)
{
  // Implicit Euler lets a sheet fall by g (t^2 + h t) / 2: all cloths are g h t / 2 too low, and
  // the difference of two of them is not.
  Scene scene = short_scene(0.01);
  scene.terms = {"membrane", "gravity"};
  scene.n1 = scene.n2 = 2;
  scene.held.clear();
  DrapeErrorBar bar = bar_of(scene);
  ASSERT_TRUE(bar.coarse_step.empty()) << "nobody asked for what costs two runs of the whole cloth";
  const DrapedCell draped = draped_in(scene);
  SceneCloth coarse(scene, draped.coarse, draped.effective, draped.coarse_motion());
  std::vector<shell::Vectors> frames = {coarse.cloth().positions()};
  for (int k = 1; k <= 4; ++k)
  {
    coarse.step(scene.time_step);
    if (k % 2 == 0)
      frames.push_back(coarse.cloth().positions());
  }
  bar.coarse_step = changes_by_halved_step(draped, frames, DrapeSchedule(scene));
  ASSERT_EQ(bar.coarse_step.size(), 3u);
  for (const std::size_t frame : {1u, 2u})
  {
    const double too_low = 0.5 * 9.81 * 0.01 * 0.02 * static_cast<double>(frame);
    EXPECT_NEAR(bar.of_coarse_step_at(frame), 1.25 * too_low, 1e-6 * too_low);
    EXPECT_LT(bar.halved_step[frame], 1e-6 * too_low);
  }
  EXPECT_TRUE(std::isnan(bar.of_coarse_step_at(3)));
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
