// SPDX-License-Identifier: MIT
// Nodes and grid of a coarse cloth, and the methods on six-node triangles.
#include "homogenization/edges/edge_layers.h"
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/refusal.h"
#include "tests/verification/method/models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace homespun;
using namespace homespun::verification;
using Positions = shell::Positions<2>;

namespace
{
homogenization::UnitCell one_phase(const double side = 0.01)
{
  return tests::cell_of(tests::square_lattice(side), 2, 2,
                        {homogenization::isotropic("cloth", 1e6, 0.3, 5e-4, 1.)},
                        [](double, double) { return 0; });
}

meshes::Sheet sheet_of(const homogenization::UnitCell &cell, const int n1, const int n2)
{
  return meshes::tile(cell.mesh, cell.lattice, n1, n2);
}

Positions random_rows(const int n)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> random(-1., 1.);
  Positions rows(n, 2);
  for (Eigen::Index k = 0; k < rows.size(); ++k)
    rows.data()[k] = random(generator);
  return rows;
}
} // namespace

TEST(exact_coarse_space, quadratic_fields_of_the_nodes_are_themselves_on_the_grid)
{
  const CoarseSpace space(sheet_of(one_phase(), 4, 6), CoarseElement::six_nodes);
  const auto values = [](const meshes::Points &x)
  {
    Positions field(x.rows(), 2);
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      field.row(v) << 1. + 2. * x(v, 0) - 3. * x(v, 0) * x(v, 1), x(v, 1) * x(v, 1) - x(v, 0);
    return field;
  };
  const Positions of_nodes = values(space.nodes.mesh.vertices);
  EXPECT_EQ(space.nodes.mesh.n_vertices(), 35);
  EXPECT_EQ(space.grid.mesh.n_vertices(), 9 * 13);
  EXPECT_LT((space.on_grid(of_nodes) - values(space.grid.mesh.vertices)).cwiseAbs().maxCoeff(),
            1e-14);
  const meshes::Points of_grid = space.on_grid<2>(of_nodes);
  for (int node = 0; node < of_nodes.rows(); ++node)
    EXPECT_LT((of_grid.row(space.grid_vertex(node)) - of_nodes.row(node)).norm(), 1e-14);
}

TEST(exact_coarse_space, loads_of_the_nodes_do_the_work_of_those_on_the_grid)
{
  const CoarseSpace space(sheet_of(one_phase(), 2, 4), CoarseElement::six_nodes);
  const Positions moved = random_rows(space.nodes.mesh.n_vertices()),
                  loads = random_rows(space.grid.mesh.n_vertices());
  EXPECT_NEAR(space.loads_of_nodes(loads).cwiseProduct(moved).sum(),
              loads.cwiseProduct(space.on_grid(moved)).sum(), 1e-12);
}

TEST(tripwire_coarse_space, an_odd_number_of_cells_has_no_six_node_triangles)
{
  const meshes::Sheet sheet = sheet_of(one_phase(), 3, 4);
  EXPECT_FALSE(CoarseSpace::fits(sheet, CoarseElement::six_nodes));
  EXPECT_TRUE(CoarseSpace::fits(sheet, CoarseElement::three_nodes));
  EXPECT_NE(tests::refusal([&]() { CoarseSpace(sheet, CoarseElement::six_nodes); }).find("3 x 4"),
            std::string::npos);
}

// A cell of one phase has no terms of edges, and its energy under biot is quadratic.
TEST(exact_coarse_space, of_one_phase_full_is_p2)
{
  const homogenization::UnitCell cell = one_phase();
  homogenization::HomogenizationOptions options;
  options.order                   = 1;
  options.second_order            = {meshes::Law::biot};
  const meshes::HomogenizedCell h = homogenization::homogenized_cell(
    cell, homogenization::homogenize(cell, options, MPI_COMM_WORLD), "test");
  const meshes::CellEdges edges = homogenization::edges_of(cell, {});
  const meshes::Sheet sheet     = sheet_of(cell, 4, 4);
  for (const char *name : {"strip-1", "shear-frame"})
    for (const Law law : {Law::linear, Law::biot})
    {
      const Load load(name);
      const auto of = [&](const char *method) {
        return tests::upsampled(method, {h, &edges}, sheet, load, law, 0.1);
      };
      const meshes::Points expected = of("localized+p2"), found = of("full");
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * 0.01) << name;
    }
}

// Positions of the edges are linear there, so that either element has them exactly: each energy is
// above that of the sheet, and with it the force, which is twice the energy over the way.
TEST(bound_coarse_space, six_nodes_are_nearer_to_the_sheet_than_three_at_the_same_vertices)
{
  const homogenization::UnitCell cell = one_phase(), quarter = one_phase(0.0025);
  const auto homogenized = [](const homogenization::UnitCell &of)
  { return homogenization::homogenized_cell(of, tests::solved(of), "test"); };
  const meshes::HomogenizedCell h = homogenized(cell), of_quarter = homogenized(quarter);
  const meshes::Sheet sheet = sheet_of(cell, 8, 8), fine = sheet_of(quarter, 32, 32);
  for (const char *name : {"strip-1", "strip-2", "shear-frame"})
  {
    const Load load(name);
    const auto force =
      [&](const char *method, const meshes::HomogenizedCell &of, const meshes::Sheet &on)
    {
      const CoarseModel model({of}, on, load, Method(method), Law::linear);
      return force_along(load, sheet.sides(), model.forces(model.solve(0.01)));
    };
    const double of_fine = force("localized", of_quarter, fine),
                 three = force("localized", h, sheet), six = force("localized+p2", h, sheet);
    EXPECT_GT(three, of_fine) << name;
    EXPECT_LT(six, three) << name;
    EXPECT_LT(std::abs(six - of_fine), 0.5 * (three - of_fine)) << name;
  }
}
