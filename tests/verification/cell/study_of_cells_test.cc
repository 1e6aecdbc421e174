// SPDX-License-Identifier: MIT
// A study of cells from end to end, as short as one can be: what of it is its own, and what the
// frame does for it.
#include "homogenization/lint/cell_reading.h"
#include "verification/cell/study_inputs.h"
#include "verification/cell/study_of_cells.h"
#include "verification/record/table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// stiffest.csv: the largest entry of C^H.
struct StiffestRow
{
  static constexpr const char *file   = "stiffest.csv";
  static constexpr std::size_t n_keys = 1;

  std::string cell;
  double stiffest = 0.;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &StiffestRow::cell, Domain::name);
    column("stiffest_N_per_m", &StiffestRow::stiffest, Domain::positive);
  }
};

class StiffestStudy final : public StudyOfCells
{
public:
  explicit StiffestStudy(const StudyOptions &options)
      : StudyOfCells("stiffest", options, MPI_COMM_SELF)
      , options(options)
  {
  }

  std::vector<std::string> folders; ///< that each cell was read from; empty: it was solved

private:
  nlohmann::ordered_json inputs() override
  {
    return nlohmann::ordered_json::object();
  }

  void open_tables() override
  {
    table = std::make_unique<Table<StiffestRow>>(options.output);
  }

  void work() override
  {
    for (const homogenization::UnitCell &cell : cells())
    {
      const AssessedCell &assessed = homogenize(cell, {}, verdicts);
      write_cell(cell, assessed);
      table->append_if_missing({cell.name, assessed.result.stiffness.maxCoeff()});
      folders.push_back(assessed.folder);
    }
  }

  StudyDescription conclude() override
  {
    return {{}, {}, {"the largest entry, not the largest energy"}};
  }

  const StudyOptions options;
  std::unique_ptr<Table<StiffestRow>> table;
};

std::string content_of(const std::string &file)
{
  std::ifstream input(file);
  return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
}
} // namespace

TEST(exact_study_of_cells, a_new_study_is_its_table_and_its_claims_and_is_taken_up)
{
  StudyOptions options;
  options.cell_files = {std::string(CELLS) + "layered.prm"};
  options.output     = testing::TempDir() + "study_of_cells";
  std::filesystem::remove_all(options.output);
  StiffestStudy study(options);
  const std::vector<Verdict> first = study.run();
  EXPECT_EQ(study.folders, std::vector<std::string>{""});
  const std::string table = content_of(options.output + "/stiffest.csv");
  EXPECT_NE(table.find("layered,"), std::string::npos);
  EXPECT_NE(content_of(options.output + "/study.json").find("largest energy"), std::string::npos);
  EXPECT_NE(content_of(options.output + "/verdicts.json").find("Hill-Mandel"), std::string::npos);
  EXPECT_NE(content_of(options.output + "/run.json").find("\"finished\": true"), std::string::npos);

  // Begun again it solves nothing, and says the same.
  StiffestStudy again(options);
  const std::vector<Verdict> second = again.run();
  EXPECT_EQ(again.folders, std::vector<std::string>{options.output + "/layered"});
  EXPECT_EQ(content_of(options.output + "/stiffest.csv"), table);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t k = 0; k < first.size(); ++k)
    EXPECT_EQ(first[k].value, second[k].value) << first[k].claim;
}

TEST(exact_fingerprint, layers_of_another_order_are_another_cell)
{
  homogenization::UnitCell one = homogenization::read_unit_cell(std::string(CELLS) + "layered.prm");
  const std::string before     = fingerprint(one);
  EXPECT_EQ(fingerprint(one), before);
  // The same c, thickness and density: what bends about a surface of its own.
  one.phases.front().plate = homogenization::Plate{2e6, 0.3, 2e-4};
  EXPECT_NE(fingerprint(one), before);
}
