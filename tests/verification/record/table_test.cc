// SPDX-License-Identifier: MIT
#include "tests/refusal.h"
#include "verification/record/schema.h"
#include "verification/record/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

namespace homespun::verification
{
namespace
{
struct Measured
{
  static constexpr const char *file   = "measured.csv";
  static constexpr std::size_t n_keys = 2;
  std::string cell;
  double strain = 0., error = 0.;
  std::optional<int> iterations;
  std::string note;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &Measured::cell, Domain::name);
    column("strain", &Measured::strain, Domain::positive);
    column("error_m", &Measured::error, Domain::not_negative);
    column("iterations", &Measured::iterations, Domain::not_negative);
    column("note", &Measured::note, Domain::text);
  }
};

/// A folder that goes away.
class Tables : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = testing::TempDir() + "homespun-tables-XXXXXX";
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }
  std::string text() const
  {
    std::ifstream input(folder + "/measured.csv");
    return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  }
  void write(const std::string &content) const
  {
    std::ofstream(folder + "/measured.csv") << content;
  }

  std::string folder;
};

using exact_tables    = Tables;
using tripwire_tables = Tables;

TEST_F(exact_tables, numbers_read_back_to_the_last_bit)
{
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::uint64_t> bits;
  std::vector<double> numbers = {0.1 + 0.2, 1. / 3., std::numeric_limits<double>::min(),
                                 std::numeric_limits<double>::denorm_min(),
                                 std::numeric_limits<double>::max()};
  while (numbers.size() < 2000)
  {
    const std::uint64_t word = bits(random);
    double number            = 0.;
    std::memcpy(&number, &word, sizeof(number));
    if (std::isfinite(number))
      numbers.push_back(std::abs(number));
  }
  {
    Table<Measured> table(folder);
    for (std::size_t k = 0; k < 50; ++k)
      table.append({"stripes", static_cast<double>(k + 1), numbers[k], {}, ""});
  }
  const Table<Measured> again(folder);
  ASSERT_EQ(again.rows().size(), 50u);
  for (std::size_t k = 0; k < 50; ++k)
    EXPECT_EQ(again.rows()[k].error, numbers[k]);
  for (const double number : numbers)
  {
    double found = 0.;
    EXPECT_TRUE(read_field(to_field(number), found));
    EXPECT_EQ(found, number) << to_field(number);
  }
}

TEST_F(exact_tables, texts_with_commas_quotes_and_line_breaks_come_back)
{
  {
    Table<Measured> table(folder);
    table.append({"a, \"b\"", 0.5, std::nan(""), 3, "one\ntwo, three"});
  }
  const Measured row = Table<Measured>(folder).rows().at(0);
  EXPECT_EQ(row.cell, "a, \"b\"");
  EXPECT_EQ(row.note, "one two, three");
  EXPECT_TRUE(std::isnan(row.error));
  EXPECT_EQ(row.iterations, 3);
}

TEST_F(exact_tables, a_table_that_was_cut_is_taken_up_without_its_last_line)
{
  {
    Table<Measured> table(folder);
    for (const double strain : {0.1, 0.2, 0.3})
      table.append({"stripes", strain, strain, {}, ""});
  }
  const std::string whole = text();
  write(whole.substr(0, whole.size() - 4));
  Table<Measured> table(folder);
  EXPECT_EQ(table.rows().size(), 2u);
  EXPECT_TRUE(table.contains({"stripes", 0.2, 0., {}, ""}));
  table.append({"stripes", 0.3, 0.3, {}, ""});
  EXPECT_EQ(text(), whole);
}

TEST_F(tripwire_tables, a_damaged_line_is_refused_by_file_line_and_column)
{
  Table<Measured>(folder).append({"stripes", 0.1, 0.2, 4, ""});
  const std::string whole = text();
  const std::string path  = folder + "/measured.csv";
  const auto refused      = [&](const std::string &line)
  {
    write(whole + line + "\n");
    const std::string said = tests::refusal([&]() { Table<Measured> table(folder); });
    EXPECT_EQ(text(), whole + line + "\n"); // nothing touched
    return said;
  };
  EXPECT_NE(refused("stripes,0.2,0.x3,4,").find(path + ":3: column `error_m`: found `0.x3`"),
            std::string::npos);
  EXPECT_NE(refused("stripes,0,0.3,4,").find("column `strain`: found `0`; expected a number above"),
            std::string::npos);
  EXPECT_NE(refused("stripes,0.2,-0.3,4,").find("column `error_m`"), std::string::npos);
  EXPECT_NE(refused("stripes,0.2,inf,4,").find("column `error_m`"), std::string::npos);
  EXPECT_NE(refused("stripes,0.2,0.3,4.5,").find("column `iterations`"), std::string::npos);
  EXPECT_NE(refused(",0.2,0.3,4,").find("column `cell`"), std::string::npos);
  EXPECT_NE(refused("stripes,0.2").find("found 2 fields; expected 5"), std::string::npos);
  write("cell,strain\n");
  EXPECT_NE(tests::refusal([&]() { Table<Measured> table(folder); }).find("measured.csv:1"),
            std::string::npos);
}

TEST_F(exact_tables, rows_with_the_same_keys_are_one)
{
  Table<Measured> table(folder);
  table.append({"stripes", 0.1, 1., {}, ""});
  table.append_if_missing({"stripes", 0.1, 2., {}, ""});
  EXPECT_EQ(table.rows().at(0).error, 1.);
  table.append({"stripes", 0.2, 3., {}, ""});
  table.keep([](const Measured &row) { return row.strain > 0.15; });
  EXPECT_EQ(Table<Measured>(folder).rows().size(), 1u);
  EXPECT_EQ(Table<Measured>(folder).rows()[0].error, 3.);
}

TEST_F(exact_tables, a_row_that_is_put_stands_in_the_file_once)
{
  Table<Measured> table(folder);
  table.put({"stripes", 0.1, 1., {}, "one"});
  table.put({"stripes", 0.2, 2., {}, ""});
  Measured known = table.known({"stripes", 0.1, 0., {}, ""});
  EXPECT_EQ(known.note, "one");
  known.note += " | two";
  table.put(known);
  EXPECT_EQ(text(), "cell,strain,error_m,iterations,note\nstripes,0.1,1,,one | two\n"
                    "stripes,0.2,2,,\n");
  EXPECT_EQ(table.known({"dots", 0.1, 0., {}, ""}).note, "");
}

TEST_F(exact_tables, the_schema_has_the_columns_of_the_file)
{
  nlohmann::ordered_json schema;
  add_to_schema<Measured>(schema);
  EXPECT_EQ(schema["measured.csv"]["keys"], 2);
  std::string header;
  for (const auto &column : schema["measured.csv"]["columns"])
    header += (header.empty() ? "" : ",") + column["name"].get<std::string>();
  const Table<Measured> table(folder);
  EXPECT_EQ(text(), header + "\n");
}
} // namespace
} // namespace homespun::verification
