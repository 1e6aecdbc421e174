// SPDX-License-Identifier: MIT
#include "meshes/files/cell_file.h"
#include "tests/meshes/files/temporary.h"
#include "tests/meshes/plain/plain_cell.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::meshes;

namespace
{
CellEdges some_edges(const int n_vertices)
{
  CellEdges edges;
  for (int side = 0; side < CellEdges::n_sides; ++side)
  {
    CellEdge &edge = edges.sides[static_cast<std::size_t>(side)];
    edge.slip.setRandom();
    edge.tension.setRandom();
    edge.decay   = 0.1 * (side + 1);
    edge.n_cells = 1 + side / 2;
    edge.clamped.setRandom(edge.n_cells * n_vertices, 6);
    edge.free.setRandom(edge.n_cells * n_vertices, 6);
  }
  for (Eigen::Matrix3d &of_axis : edges.bulk)
    of_axis.setRandom();
  return edges;
}
} // namespace

TEST(exact_cell_terms_file, edges_come_back_as_they_were_written)
{
  HomogenizedCell cell   = tests::plain_cell(tests::skewed_lattice(), 3, 2);
  const CellEdges edges  = some_edges(cell.mesh.n_vertices());
  const std::string file = tests::temporary("edges-round-trip.h5");
  cell.edges             = edges;
  write_cell(cell, file);
  const std::optional<CellEdges> back = read_cell(file).edges;
  ASSERT_TRUE(back.has_value());
  for (std::size_t k = 0; k < edges.sides.size(); ++k)
  {
    EXPECT_EQ(back->sides[k].slip, edges.sides[k].slip);
    EXPECT_EQ(back->sides[k].tension, edges.sides[k].tension);
    EXPECT_EQ(back->sides[k].decay, edges.sides[k].decay);
    EXPECT_EQ(back->sides[k].clamped, edges.sides[k].clamped);
    EXPECT_EQ(back->sides[k].free, edges.sides[k].free);
  }
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_EQ(back->bulk[b], edges.bulk[b]);
}

TEST(exact_cell_terms_file, a_file_without_terms_has_none)
{
  const std::string file = tests::temporary("edges-without.h5");
  write_cell(tests::plain_cell(tests::skewed_lattice(), 3, 2), file);
  EXPECT_FALSE(read_cell(file).edges.has_value());
  EXPECT_TRUE(read_cell(file).fitted.empty());
}

TEST(exact_cell_terms_file, fitted_modes_come_back_as_they_were_written)
{
  HomogenizedCell cell = tests::plain_cell(tests::skewed_lattice(), 3, 2);
  FittedModes &fitted  = cell.fitted["yarn"];
  fitted.low << -0.1, -0.2, -0.3;
  fitted.high << 0.1, 0.2, 0.3;
  fitted.knees << 0.4, 0.5, 0.6;
  fitted.modes.setRandom(cell.mesh.n_vertices(), 12);
  fitted.coefficients.setRandom();
  fitted.of_strain.setRandom();
  const std::string file = tests::temporary("edges-fitted.h5");
  write_cell(cell, file);
  const FittedModes back = read_cell(file).fitted.at("yarn");
  EXPECT_EQ(back.low, fitted.low);
  EXPECT_EQ(back.high, fitted.high);
  EXPECT_EQ(back.knees, fitted.knees);
  EXPECT_EQ(back.modes, fitted.modes);
  EXPECT_EQ(back.coefficients, fitted.coefficients);
  EXPECT_EQ(back.of_strain, fitted.of_strain);
  fitted.knees(1) = 0.;
  write_cell(cell, file);
  EXPECT_NE(tests::refusal([&]() { read_cell(file); }).find("/fitted/yarn/ holds values"),
            std::string::npos);
}

TEST(tripwire_cell_terms_file, modes_that_are_not_those_of_the_cell_are_refused)
{
  HomogenizedCell cell       = tests::plain_cell(tests::skewed_lattice(), 3, 2);
  cell.edges                 = some_edges(cell.mesh.n_vertices());
  cell.edges->sides[1].decay = 1.5;
  const std::string file     = tests::temporary("edges-damaged.h5");
  write_cell(cell, file);
  EXPECT_NE(tests::refusal([&]() { read_cell(file); }).find("edge 1"), std::string::npos);
}
