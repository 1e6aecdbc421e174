// SPDX-License-Identifier: MIT
#include "meshes/files/cell_edges_file.h"
#include "meshes/files/cell_file.h"
#include "meshes/plain/errors.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace homespun;
using namespace homespun::meshes;

namespace
{
HomogenizedCell plain_cell()
{
  HomogenizedCell cell;
  cell.lattice = tests::skewed_lattice();
  cell.mesh    = tests::parallelogram(cell.lattice, 3, 2);
  cell.chi.setZero(cell.mesh.n_vertices(), 6);
  cell.stiffness     = Eigen::Matrix3d::Identity();
  cell.areal_density = 0.2;
  return cell;
}

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

std::string temporary(const std::string &name)
{
  return (std::filesystem::temp_directory_path() / ("homespun-edges-" + name)).string();
}
} // namespace

TEST(exact_cell_edges_file, edges_come_back_as_they_were_written)
{
  const HomogenizedCell cell = plain_cell();
  const CellEdges edges      = some_edges(cell.mesh.n_vertices());
  const std::string file     = temporary("round-trip.h5");
  write_cell(cell, edges, file);
  EXPECT_EQ(read_cell(file).mesh.vertices, cell.mesh.vertices);
  const std::optional<CellEdges> back = read_cell_edges(file);
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

TEST(exact_cell_edges_file, a_file_without_edges_has_none)
{
  const std::string file = temporary("without.h5");
  write_cell(plain_cell(), file);
  EXPECT_FALSE(read_cell_edges(file).has_value());
}

TEST(tripwire_cell_edges_file, modes_that_are_not_those_of_the_cell_are_refused)
{
  const HomogenizedCell cell = plain_cell();
  CellEdges edges            = some_edges(cell.mesh.n_vertices());
  edges.sides[1].decay       = 1.5;
  const std::string file     = temporary("damaged.h5");
  write_cell(cell, edges, file);
  try
  {
    read_cell_edges(file);
    FAIL();
  }
  catch (const BadInput &refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("edge 1"), std::string::npos) << refusal.what();
  }
}
