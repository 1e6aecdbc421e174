// SPDX-License-Identifier: MIT
#include "meshes/errors.h"
#include "verification/result_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

using namespace homespun;
using namespace homespun::verification;

namespace
{
const std::vector<std::string> columns = {"cell", "load", "error"};

std::string temporary(const std::string &name)
{
  return (std::filesystem::temp_directory_path() / ("homespun-" + name)).string();
}

std::string content_of(const std::string &file)
{
  std::ifstream input(file);
  std::stringstream text;
  text << input.rdbuf();
  return text.str();
}
} // namespace

TEST(exact_result_table, a_number_comes_back_and_a_damaged_one_is_none)
{
  for (const double value : {0., -1.25, 3e-7, 1e12})
    EXPECT_EQ(csv_value(csv_number(value)), value);
  for (const char *damaged : {"", "x", "1.5x", "1.5 "})
    EXPECT_TRUE(std::isnan(csv_value(damaged))) << damaged;
}

TEST(exact_result_table, rows_are_on_the_disk_as_they_come)
{
  const std::string file = temporary("rows.csv");
  ResultTable table(file, columns, 2, false);
  EXPECT_EQ(content_of(file), "cell,load,error\n");
  table.append({"a", "strip-1", "0.5"});
  EXPECT_EQ(content_of(file), "cell,load,error\na,strip-1,0.5\n");
  EXPECT_TRUE(table.contains({"a", "strip-1"}));
  EXPECT_FALSE(table.contains({"a", "strip-2"}));
}

TEST(exact_result_table, taken_up_again_after_a_kill_only_the_row_in_progress_is_lost)
{
  const std::string file  = temporary("cut.csv"),
                    whole = "cell,load,error\na,strip-1,0.5\nb,strip-1,0.25\n";
  for (std::size_t length = 0; length <= whole.size(); ++length)
  {
    std::ofstream(file) << whole.substr(0, length);
    if (length < 16)
    {
      // Not even the header is whole.
      EXPECT_THROW(ResultTable(file, columns, 2, true), meshes::BadInput);
      continue;
    }
    ResultTable table(file, columns, 2, true);
    EXPECT_EQ(table.contains({"a", "strip-1"}), length >= 30) << length;
    EXPECT_EQ(table.contains({"b", "strip-1"}), length == whole.size()) << length;
    if (!table.contains({"a", "strip-1"}))
      table.append({"a", "strip-1", "0.5"});
    if (!table.contains({"b", "strip-1"}))
      table.append({"b", "strip-1", "0.25"});
    EXPECT_EQ(content_of(file), whole) << length;
  }
}

TEST(tripwire_result_table, another_header_and_a_broken_row_are_refused_by_line)
{
  const std::string file = temporary("other.csv");
  const auto refusal     = [&](const std::string &content) -> std::string
  {
    std::ofstream(file) << content;
    try
    {
      ResultTable(file, columns, 2, true);
      return "";
    }
    catch (const meshes::BadInput &bad)
    {
      return bad.what();
    }
  };
  EXPECT_NE(refusal("a,b\n1,2\n").find("other.csv:1: found the header `a,b`"), std::string::npos);
  EXPECT_NE(refusal("cell,load,error\na,b\n").find("other.csv:2: found 2 fields; expected 3"),
            std::string::npos);
}

TEST(invariant_result_files, values_that_are_not_finite_never_reach_a_file)
{
  EXPECT_EQ(csv_number(std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(csv_number(std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(csv_number(1. / 3.), "0.333333");
  EXPECT_EQ(csv_number(1e-17), "1e-17");
}

TEST(tripwire_result_files, a_folder_that_does_not_exist_is_named)
{
  EXPECT_THROW(write_whole("/nowhere/at/all.json", "{}"), meshes::BadInput);
}

TEST(invariant_result_files, rows_that_are_not_kept_leave_the_file_too)
{
  const std::string file = temporary("kept.csv");
  ResultTable table(file, columns, 2, false);
  for (const char *load : {"a", "b", "c"})
    table.append({"cell", load, "1"});
  table.keep([](const std::vector<std::string> &row) { return row[1] != "b"; });
  EXPECT_EQ(table.rows().size(), 2u);
  EXPECT_FALSE(table.contains({"cell", "b"}));
  EXPECT_EQ(ResultTable(file, columns, 2, true).rows(), table.rows());
}
