// SPDX-License-Identifier: MIT
// cell.h5 as another reader finds it: the file passes, and one whose chi is stored in another order
// or anchored elsewhere does not.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "meshes/files/cell_file.h"
#include "verification/cell/cell_file_verdicts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

using namespace homespun;
using namespace homespun::verification;

namespace
{
std::vector<Verdict> judged(const std::string &name,
                            const std::function<void(meshes::HomogenizedCell &)> &change)
{
  const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + name + ".prm");
  homogenization::HomogenizationOptions p1;
  p1.order = 1;
  meshes::HomogenizedCell stored =
    homogenization::homogenized_cell(cell, homogenization::homogenize(cell, p1, MPI_COMM_SELF), "");
  change(stored);
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("cell-file-verdicts-" + std::to_string(::getpid()) + ".h5");
  meshes::write_cell(stored, file);
  const std::vector<Verdict> verdicts = cell_file_verdicts(file, cell);
  std::filesystem::remove(file);
  return verdicts;
}
} // namespace

TEST(exact_cell_file_verdicts, cells_of_all_lattices_pass)
{
  for (const char *name : {"chevron", "hexagonal-dots", "honeycomb", "plain-weave"})
    for (const Verdict &verdict : judged(name, [](meshes::HomogenizedCell &) {}))
      EXPECT_EQ(verdict.outcome, Outcome::pass) << verdict.claim << " " << verdict.value;
}

TEST(tripwire_cell_file_verdicts, components_stored_load_by_load_are_noticed)
{
  const auto verdicts = judged("chevron",
                               [](meshes::HomogenizedCell &cell)
                               {
                                 const meshes::Chi chi = cell.chi; // row: load-major
                                 for (int a = 0; a < 3; ++a)
                                   for (int c = 0; c < 2; ++c)
                                   {
                                     const int stored = 3 * c + a; // place in the file
                                     cell.chi.col(2 * a + c) =
                                       chi.col(stored); // as if load-major were stored
                                   }
                               });
  EXPECT_EQ(verdicts.at(0).outcome, Outcome::fail);
}

TEST(tripwire_cell_file_verdicts, the_other_sign_and_another_anchor_are_noticed)
{
  EXPECT_EQ(judged("chevron", [](meshes::HomogenizedCell &cell) { cell.chi *= -1.; }).at(0).outcome,
            Outcome::fail);
  const auto moved = judged("chevron",
                            [](meshes::HomogenizedCell &cell)
                            {
                              Eigen::Index inside = 0;
                              (cell.mesh.vertices.rowwise() - cell.mesh.vertices.colwise().mean())
                                .rowwise()
                                .norm()
                                .minCoeff(&inside);
                              const Eigen::RowVectorXd there = cell.chi.row(inside);
                              cell.chi.rowwise() -= there.head<6>();
                              cell.anchor = static_cast<int>(inside);
                            });
  EXPECT_EQ(moved.at(0).outcome, Outcome::pass); // a constant has no energy
  EXPECT_EQ(moved.at(1).outcome, Outcome::fail);
}
