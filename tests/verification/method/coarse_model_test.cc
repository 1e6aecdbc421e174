// SPDX-License-Identifier: MIT
// A method on a sheet: what a solve depends on, and what its terms change.
#include "homogenization/edges/edge_layers.h"
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/verification/method/models.h"
#include "verification/method/mode_fit.h"

#include <gtest/gtest.h>

#include <string>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A shipped cell with all that methods ask for under a law.
struct WholeCell
{
  WholeCell(const char *name, const Law law)
      : cell(homogenization::read_unit_cell(CELLS + std::string(name) + ".prm", MPI_COMM_WORLD))
      , homogenized(made(cell, law))
      , edges(homogenization::edges_of(cell, {}))
  {
    if (is_of_yarns(law))
      fitted = fit_modes(NonlinearCell(homogenized, cell.stiffness_of_phase(), law), homogenized,
                         box_up_to(0.01, law))
                 .modes;
  }

  static meshes::HomogenizedCell made(const homogenization::UnitCell &cell, const Law law)
  {
    homogenization::HomogenizationOptions options;
    options.order = 1;
    if (meshes::properties_of(law).has_second_order)
      options.second_order = {law};
    return homogenization::homogenized_cell(
      cell, homogenization::homogenize(cell, options, MPI_COMM_WORLD), "test");
  }

  CellModel model(const Law law) const
  {
    return {homogenized, &edges, is_of_yarns(law) ? &fitted : nullptr};
  }

  const homogenization::UnitCell cell;
  const meshes::HomogenizedCell homogenized;
  const meshes::CellEdges edges;
  meshes::FittedModes fitted;
};
} // namespace

// What is added to the coarse motion is worth what it gains on the same coarse motion.
TEST(exact_coarse_model, without_micro_the_coarse_cloth_is_the_same_to_the_bit)
{
  for (const auto &[name, law] :
       {std::pair("three-stiffness", Law::biot), std::pair("three-stiffness", Law::linear),
        std::pair("plain-weave-straight", Law::yarn)})
  {
    const WholeCell of(name, law);
    const meshes::Sheet sheet = meshes::tile(of.cell.mesh, of.cell.lattice, 4, 4);
    for (const char *load_name : {"strip-1", "shear-frame"})
    {
      const Load load(load_name);
      const CoarseModel full(of.model(law), sheet, load, Method("full"), law),
        less(of.model(law), sheet, load, Method("full-micro"), law);
      const CoarseState state = full.solve(0.01), same = less.solve(0.01);
      EXPECT_EQ(state.positions, same.positions) << name << load_name;
      EXPECT_EQ(state.iterations, same.iterations);
      EXPECT_NE(state.positions, state.without_edges);
      // Nothing is added: the motion of the grid, interpolated.
      EXPECT_EQ(less.upsample(same), tests::interpolated(of.homogenized, less, sheet, law, same));
      EXPECT_GT((full.upsample(state) - less.upsample(same)).norm(), 0.);
    }
  }
}

TEST(exact_coarse_model, a_solve_depends_on_no_other_and_hardly_on_its_start)
{
  const WholeCell of("three-stiffness", Law::biot);
  const meshes::Sheet sheet = meshes::tile(of.cell.mesh, of.cell.lattice, 4, 4);
  const CoarseModel model(of.model(Law::biot), sheet, Load("shear-frame"), Method("full"),
                          Law::biot);
  const CoarseState cold = model.solve(0.1), small = model.solve(0.05);
  EXPECT_EQ(model.solve(0.1).positions, cold.positions);
  const CoarseState warm = model.solve(0.1, &small);
  EXPECT_LE(warm.iterations, cold.iterations);
  EXPECT_LT((warm.positions - cold.positions).cwiseAbs().maxCoeff(), 1e-9 * 0.01);
  EXPECT_NE(warm.positions, small.positions);
}

// Two quads per cell fill any sheet with triangles two quads wide.
TEST(exact_coarse_model, six_nodes_ask_for_an_even_number_of_quads_and_not_of_cells)
{
  const WholeCell of("three-stiffness", Law::linear);
  const meshes::Sheet sheet = meshes::tile(of.cell.mesh, of.cell.lattice, 3, 3);
  const Load load("strip-1");
  const auto has_p2 = [&](const int per_cell)
  {
    return CoarseModel(of.model(Law::linear), sheet, load, Method("full"), Law::linear,
                       quads_per_cell(sheet, per_cell))
      .method.has(Term::p2);
  };
  EXPECT_FALSE(has_p2(1));
  EXPECT_TRUE(has_p2(2));
}
