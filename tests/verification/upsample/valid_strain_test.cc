// SPDX-License-Identifier: MIT
// Up to which strain a cell was found valid, read back from the table of a study.
#include "meshes/files/cell_file.h"
#include "meshes/files/temporary_folder.h"
#include "meshes/files/write_whole.h"
#include "tests/localization/localization_cases.h"
#include "tests/refusal.h"
#include "verification/record/table.h"
#include "verification/record/validity_table.h"
#include "verification/upsample/valid_strain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

namespace homespun::verification
{
namespace
{
namespace fs = std::filesystem;
using localization::Law;
} // namespace

TEST(exact_valid_strain, the_load_that_fails_first_decides)
{
  const meshes::TemporaryFolder folder(testing::TempDir());
  const std::string path = folder.path;
  const auto given_of    = [](const char *const method) {
    return localization::GivenMethod{localization::Method(method), Law::biot, "", {}};
  };
  const localization::GivenMethod localized = given_of("localized");
  meshes::HomogenizedCell made              = tests::skewed_cloth().cell;
  made.stiffness                            = 100. * Eigen::Matrix3d::Identity();
  made.areal_density                        = 0.1;
  const std::string cell                    = path + "/dots/cell.h5";
  fs::create_directories(path + "/dots");
  EXPECT_FALSE(valid_strain(made, cell, "", 0.01, localized).has_value());
  {
    Table<ValidityRow> table(path);
    const auto add = [&](const std::string &of, const std::string &load, const double limit,
                         const std::string &relation, const double strain,
                         const std::string &method = "localized")
    {
      ValidityRow row;
      row.cell      = of;
      row.load      = load;
      row.reference = "biot";
      row.method    = method;
      row.measure   = "cell side";
      row.limit     = limit;
      row.relation  = relation;
      row.largest   = strain;
      table.append(row);
    };
    add("dots", "strip-1", 0.01, "=", 0.2);
    add("dots", "shear-frame", 0.01, "=", 0.3);
    add("dots", "strip-1", 0.05, ">", 0.5);
    for (const char *const load : {"strip-1", "shear-frame"})
      for (const char *const method : {"full", "localized+modes"})
        add("dots", load, 0.01, "=", 0.001, method);
    add("dots", "strip-1", 0.01, "=", 0.001, "localized+edges"); // not of all loads
    add("other", "strip-1", 0.01, "=", 0.001);
    add("all", "periodic-all", 0.01, "=", 0.1);
    add("all", "shear-frame", 0.01, "?", std::numeric_limits<double>::quiet_NaN());
    add("blind", "strip-1", 0.01, "?", std::numeric_limits<double>::quiet_NaN());
    add("bad", "strip-1", 0.01, "=", 0.1);
    add("bad", "strip-2", 0.01, "-", std::numeric_limits<double>::quiet_NaN());
  }
  const auto found = valid_strain(made, cell, "", 0.01, localized);
  ASSERT_TRUE(found.has_value());
  // Simple shear by 0.3 stretches by sqrt(1 + 0.3²/4) + 0.15.
  EXPECT_NEAR(found->strain, std::sqrt(1. + 0.0225) + 0.15 - 1., 1e-14);
  EXPECT_EQ(found->load, "shear-frame");
  EXPECT_FALSE(found->is_open);
  EXPECT_EQ(found->method, "localized");
  // Rows of the terms that are used, by whatever name; where there are none, those of `localized`.
  localization::GivenMethod given = given_of("localized+p2+cubic+edges+modes");
  const auto method_of_rows = [&]() { return valid_strain(made, cell, "", 0.01, given)->method; };
  given.options.slip        = localization::Slip::of_cloth;
  EXPECT_EQ(method_of_rows(), "full");
  EXPECT_NEAR(valid_strain(made, cell, "", 0.01, given)->strain, 0.0005, 1e-6);
  given.options.slip = localization::Slip::added; // the coarse cloths of the study had their own
  EXPECT_EQ(method_of_rows(), "localized");
  given.used = localization::Method("localized+modes");
  EXPECT_EQ(method_of_rows(), "localized+modes");
  given.law = Law::yarn; // other modes
  EXPECT_EQ(method_of_rows(), "localized");
  given              = given_of("localized+edges");
  given.options.slip = localization::Slip::of_cloth;
  EXPECT_EQ(method_of_rows(), "localized");
  EXPECT_TRUE(valid_strain(made, cell, path + "/validity.csv", 0.05, localized)->is_open);
  EXPECT_EQ(
    valid_strain(made, path + "/bad/cell.h5", path + "/validity.csv", 0.01, localized)->strain, 0.);

  // F = [1.1 0.1; 0 1.05]: half the trace of F^T F, and half the difference of its eigenvalues.
  const double half  = 0.5 * (1.21 + 0.01 + 1.1025),
               apart = std::sqrt(half * half - 1.1 * 1.1 * 1.05 * 1.05);
  EXPECT_NEAR(
    valid_strain(made, path + "/all/cell.h5", path + "/validity.csv", 0.01, localized)->strain,
    std::sqrt(half + apart) - 1., 1e-14);

  EXPECT_NE(valid_strain(made, path + "/all/cell.h5", path + "/validity.csv", 0.01, localized)
              ->unknown.find("of shear-frame no range is known"),
            std::string::npos);
  EXPECT_FALSE(
    valid_strain(made, path + "/blind/cell.h5", path + "/validity.csv", 0.01, localized));

  const auto refused = [&](const std::string &of, const std::string &file, const double limit)
  { return tests::refusal([&]() { valid_strain(made, of, file, limit, localized); }); };
  EXPECT_NE(refused(cell, "", 0.02).find("and limit 0.02; found the limits 0.01, 0.05"),
            std::string::npos);
  EXPECT_NE(
    refused(path + "/none/cell.h5", path + "/validity.csv", 0.01)
      .find(
        "holds the cells all, bad, blind, dots, other; expected one cell, or one that is named"),
    std::string::npos);
  EXPECT_NE(refused(cell, path + "/no.csv", 0.01).find("no.csv: no such file"), std::string::npos);

  // The cell that the run of the table left beside it: the same, one of another mesh, two others.
  const auto left = [&](const double stiffer, const double longer)
  {
    meshes::HomogenizedCell tried = made;
    tried.stiffness *= stiffer;
    tried.lattice.vectors *= longer;
    meshes::write_cell(tried, cell);
  };
  for (const double stiffer : {1., 1.04})
  {
    left(stiffer, 1.);
    EXPECT_TRUE(valid_strain(made, cell, "", 0.01, localized).has_value()) << stiffer;
  }
  left(1.06, 1.);
  EXPECT_FALSE(valid_strain(made, cell, "", 0.01, localized).has_value());
  EXPECT_NE(refused(cell, path + "/validity.csv", 0.01).find("cell.h5, whose C^H is another one"),
            std::string::npos);
  left(1., 1.00001);
  EXPECT_NE(refused(cell, path + "/validity.csv", 0.01).find("whose lattice is another one"),
            std::string::npos);
  left(1., 1.);
  meshes::write_whole(path + "/run.json", "{\"format_version\": 9}");
  EXPECT_NE(refused(cell, "", 0.01).find("run.json: found format_version 9"), std::string::npos);
}

} // namespace homespun::verification
