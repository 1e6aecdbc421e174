// SPDX-License-Identifier: MIT
// Cells that studies hand on to one another, in memory and through their files.
#include "verification/cell/assessed_cells.h"
#include "verification/cell/cell_files.h"
#include "verification/stress/stress_cells.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace homespun;
using namespace homespun::verification;

namespace
{
UnitCell small_inclusion()
{
  return inclusion_cell(6, homogenization::isotropic("soft", 1e6, 0.3, 1e-3, 100.),
                        homogenization::isotropic("hard", 1e7, 0.3, 1e-3, 100.));
}

CellNeeds needs_of(const std::vector<meshes::Law> &laws)
{
  CellNeeds needs;
  needs.second_order = laws;
  return needs;
}

constexpr auto biot = meshes::Law::biot;
} // namespace

TEST(exact_assessed_cells, a_cell_is_homogenized_once_for_all_who_ask)
{
  const UnitCell cell = small_inclusion();
  AssessedCells cells;
  std::vector<Verdict> first, second;
  const AssessedCell &one   = cells.of(cell, needs_of({biot}), MPI_COMM_SELF, first);
  const auto seconds        = one.result.seconds.solve;
  const AssessedCell &other = cells.of(cell, {}, MPI_COMM_SELF, second);
  EXPECT_EQ(&one, &other);
  EXPECT_EQ(seconds, other.result.seconds.solve);
  EXPECT_EQ(other.result.second_order.count("biot"), 1u);
  ASSERT_EQ(first.size(), second.size());
  ASSERT_FALSE(first.empty());
  EXPECT_EQ(first.front().claim, second.front().claim);
  // Another cell of the same name is another cell.
  UnitCell stiffer = cell;
  stiffer.phases.front().E1 *= 2.;
  EXPECT_GT(
    (cells.of(stiffer, {}, MPI_COMM_SELF, second).result.stiffness - one.result.stiffness).norm(),
    0.01 * one.result.stiffness.norm());
  // What nobody asked for so far is made.
  EXPECT_EQ(
    cells.of(stiffer, needs_of({biot}), MPI_COMM_SELF, second).result.second_order.count("biot"),
    1u);
}

TEST(exact_assessed_cells, bending_that_is_there_is_taken_over)
{
  const UnitCell cell = small_inclusion();
  CellBending bending = bending_of(cell, {}, [](const std::string &) {});
  ASSERT_TRUE(bending.bracket);
  bending.bracket->stiffness *= 1. + 1e-9; // its mark
  AssessedCells cells;
  cells.take_bending(cell, bending);
  CellNeeds needs;
  needs.bending = true;
  std::vector<Verdict> with, without;
  EXPECT_EQ(cells.of(cell, needs, MPI_COMM_SELF, with).bending->bracket->stiffness,
            bending.bracket->stiffness);
  cells.of(cell, {}, MPI_COMM_SELF, without);
  EXPECT_GT(with.size(), without.size()); // its checks are those of who asked for it
}

TEST(exact_assessed_cells, what_is_read_from_its_files_is_what_was_solved)
{
  const UnitCell cell      = small_inclusion();
  const std::string folder = testing::TempDir() + "assessed_cells";
  std::filesystem::remove_all(folder);
  AssessedCells solved, read;
  std::vector<Verdict> of_solved, of_read;
  const AssessedCell &one = solved.of(cell, needs_of({biot}), MPI_COMM_SELF, of_solved);
  EXPECT_FALSE(read.read(cell, folder, MPI_COMM_SELF));
  write_cell_results(cell, one, {}, 1, folder);
  ASSERT_TRUE(read.read(cell, folder, MPI_COMM_SELF));
  const AssessedCell &other = read.of(cell, needs_of({biot}), MPI_COMM_SELF, of_read);
  EXPECT_EQ(other.folder, folder); // it was not solved again
  EXPECT_EQ(one.result.stiffness, other.result.stiffness);
  EXPECT_EQ(one.result.chi, other.result.chi);
  EXPECT_EQ(one.result.anchor, other.result.anchor);
  EXPECT_EQ(one.result.voigt, other.result.voigt);
  EXPECT_EQ(one.result.reuss, other.result.reuss);
  EXPECT_EQ(one.result.second_order.at("biot").chi, other.result.second_order.at("biot").chi);
  ASSERT_EQ(of_solved.size(), of_read.size());
  for (std::size_t k = 0; k < of_read.size(); ++k)
  {
    EXPECT_EQ(of_solved[k].claim, of_read[k].claim);
    EXPECT_EQ(of_solved[k].outcome, of_read[k].outcome);
    EXPECT_EQ(of_solved[k].kind, of_read[k].kind);
    EXPECT_EQ(of_solved[k].value, of_read[k].value) << of_read[k].claim;
    EXPECT_EQ(of_solved[k].limit, of_read[k].limit);
  }
  // Its files go with it to another study's folder.
  const std::string elsewhere = folder + "-elsewhere";
  std::filesystem::remove_all(elsewhere);
  write_cell_results(cell, other, {}, 1, elsewhere);
  EXPECT_TRUE(std::filesystem::exists(elsewhere + "/homogenize.json"));
}
