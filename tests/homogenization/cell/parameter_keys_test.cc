// SPDX-License-Identifier: MIT
// Keys of .prm files against deal.II's own ParameterHandler, which they take the place of.
#include "homogenization/cell/cell_keys.h"
#include "homogenization/cell/parameter_keys.h"
#include "meshes/files/temporary_folder.h"

#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
struct Values
{
  std::string one = "abc", other, owner;

  /// @param keys those of homespun, or those of deal.II
  template <typename Add>
  void declare(const Add &add)
  {
    add("Key of two", one,
        "A key [m] with a text that goes on and on until it has to be broken because the line is "
        "full, `really`, and then into a third line, so that every seam of the text is there.");
    // 76 letters: as the last line one too many, before others not (as the first of the next key).
    add("Other", other,
        "A garment in place of a sheet: an OBJ file with `vt`, relative to this file.");
    add("Owner's", owner,
        "triangles or quadrilaterals: .msh, .vtk, .vtu, .ucd, .inp, .unv, .med or any other that "
        "meshio reads.");
  }
  std::string all() const
  {
    return "[" + one + "][" + other + "][" + owner + "]";
  }
};

struct Read
{
  std::string values, documented;
  Faults faults;
};

Read read_by_homespun(const std::string &content)
{
  const meshes::TemporaryFolder folder(".");
  const std::string file = folder.path + "/keys.prm";
  std::ofstream(file) << content;
  Values values;
  ParameterKeys keys;
  values.declare([&](const char *name, std::string &value, const char *text)
                 { keys.add(name, value, text); });
  Read read;
  read.documented = keys.documented();
  parse_parameters(file, keys, read.faults);
  read.values = values.all();
  return read;
}

Read read_by_dealii(const std::string &content)
{
  Values values;
  dealii::ParameterHandler keys;
  values.declare([&](const char *name, std::string &value, const char *text)
                 { keys.add_parameter(name, value, text); });
  Read read;
  std::ostringstream text;
  keys.print_parameters(text, dealii::ParameterHandler::PRM);
  read.documented = text.str();
  std::istringstream input(content);
  keys.parse_input(input, "keys.prm", "", true);
  read.values = values.all();
  return read;
}

TEST(invariant_parameter_keys, values_and_documentation_are_those_of_dealii)
{
  for (const char *content :
       {"", "# nothing\n\n", "set Key of two = 1 2  3\t4 # a comment\n", "set\tOther\t=\t5\r\n",
        "set Other = a = b\n", "set Other =\n",
        " set Owner's = \"q\" \nset Key of two = soft: 1e6, hard: 1e7", "set Other = x#y\n",
        "\tset Other = 1;\n\n#set Other = 7\nset Key of two =   \n"})
  {
    const Read ours = read_by_homespun(content), theirs = read_by_dealii(content);
    EXPECT_EQ(ours.values, theirs.values) << content;
    EXPECT_EQ(ours.documented, theirs.documented);
    EXPECT_TRUE(ours.faults.empty()) << content;
  }
}

// deal.II passes over the key that it does not know like that, and takes braces for a list of runs.
TEST(invariant_parameter_keys, blanks_in_a_key_and_braces_in_a_value_lose_nothing)
{
  EXPECT_EQ(read_by_homespun("set Key   of  two = q\n").values, "[q][][]");
  EXPECT_EQ(read_by_homespun("set Other = {1|2}\n").values, "[abc][{1|2}][]");
}

// deal.II joins such a line with the next one, whose key would be lost without a word.
TEST(invariant_parameter_keys, a_line_that_would_go_on_is_refused)
{
  const Read read = read_by_homespun("set Other = 7 \\\nset Owner's = 8\n");
  ASSERT_EQ(read.faults.size(), 1u);
  EXPECT_NE(read.faults[0].find(":1: found `set Other = 7 \\`; expected the whole value in one "
                                "line"),
            std::string::npos)
    << read.faults[0];
}

// deal.II takes the last one.
TEST(invariant_parameter_keys, a_key_that_is_given_twice_is_refused)
{
  const Read read = read_by_homespun("set Other=4\nset Other = 5\n");
  ASSERT_EQ(read.faults.size(), 1u);
  EXPECT_NE(read.faults[0].find(":2: key `Other` is given twice"), std::string::npos)
    << read.faults[0];
  EXPECT_EQ(read.values, "[abc][][]");
}

TEST(invariant_parameter_keys, faults_are_told_all_at_once_and_change_no_value)
{
  const Read read = read_by_homespun("set Other = 7\nset Othre = 8\nOther = 9\n");
  ASSERT_EQ(read.faults.size(), 2u);
  EXPECT_NE(read.faults[0].find(":2: unknown key `Othre`; expected one of Key of two, Other, "
                                "Owner's; did you mean `Other`?"),
            std::string::npos)
    << read.faults[0];
  EXPECT_NE(read.faults[1].find(":3: found `Other = 9`; expected `set KEY = VALUE`"),
            std::string::npos)
    << read.faults[1];
  EXPECT_EQ(read.values, "[abc][][]");
}
} // namespace
} // namespace homespun::homogenization
