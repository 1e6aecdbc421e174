// SPDX-License-Identifier: MIT
// The grammar of methods, and what of them has a meaning where.
#include "tests/refusal.h"
#include "verification/method/method.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

using namespace homespun;
using namespace homespun::verification;

namespace
{
std::string refusal_of(const std::string &text)
{
  return tests::refusal([&]() { Method{text}; });
}
} // namespace

TEST(exact_method, terms_come_back_in_one_order)
{
  for (const auto &[text, name] : std::vector<std::pair<std::string, std::string>>{
         {"localized", "localized"},
         {"localized+modes+p2+cubic", "localized+p2+cubic+modes"},
         {"full-micro-edges", "full-edges-micro"},
         {"affine+p2", "affine+p2"}})
    EXPECT_EQ(Method(text).name, name);
  EXPECT_TRUE(Method("full-cubic-modes-curved").has_terms_of(Method("localized+edges+p2")));
  EXPECT_TRUE(Method("localized-micro").has_terms_of(Method("affine")));
}

TEST(invariant_method, faults_are_named)
{
  for (const auto &[text, words] : std::vector<std::pair<std::string, std::string>>{
         {"nodal-warping", "no preset is called `nodal`"},
         {"", "no preset is called ``"},
         {"localized+tension", "no term is called `tension`"},
         {"localized+", "no term is called ``"},
         {"localized+p2+p2", "the term p2 is there twice"},
         {"localized+p2-p2", "the term p2 is there twice"},
         {"localized+micro", "localized has the term micro already"},
         {"full+edges", "full has the term edges already"},
         {"affine-micro", "affine has no term micro to take away"}})
    EXPECT_NE(refusal_of(text).find(words), std::string::npos) << text << ": " << refusal_of(text);
}

// The table of the names of version 0.1.
TEST(exact_method, old_names_are_what_they_were)
{
  EXPECT_EQ(Method::name_of_old("localized"), "");
  EXPECT_EQ(Method::name_of_old("p2"), "localized+p2");
  const Load sheet("strip-1");
  const auto is = [&](const char *old, const Law law, const std::vector<std::string> &terms)
  {
    EXPECT_EQ(under(Method(Method::name_of_old(old)), law, sheet).term_names(), terms)
      << old << name_of(law);
  };
  is("quadratic", Law::biot, {"cubic", "modes", "micro"});
  is("fitted", Law::yarn, {"modes", "micro"}); // under other laws such modes are no more
  is("first-order", Law::yarn, {"p2", "edges", "micro"});
  is("full-fitted", Law::yarn, {"p2", "edges", "modes", "micro"});
}

TEST(exact_method, a_law_and_a_load_leave_what_has_a_meaning)
{
  const Method full("full");
  const Load sheet("shear-frame"), infinite("uniaxial-1");
  for (const auto &[law, terms] :
       std::vector<std::pair<Law, std::string>>{{Law::linear, "cubic, modes and curved"},
                                                {Law::biot, "curved"},
                                                {Law::green, "curved"},
                                                {Law::yarn, "cubic and curved"}})
  {
    EXPECT_EQ(full.beyond(under(full, law, sheet)), terms) << name_of(law);
    EXPECT_EQ(full.under(law).beyond(under(full, law, infinite)), "p2, edges and curved")
      << name_of(law);
  }
  EXPECT_EQ(full.beyond(Method("affine")), "p2, edges, cubic, modes, curved and micro");
  EXPECT_TRUE(full.has_fitted_modes(Law::yarn));
  EXPECT_FALSE(full.has_fitted_modes(Law::biot));
  EXPECT_EQ(full.options(Law::green).second_order, "green");
  EXPECT_EQ(full.options(Law::yarn).second_order, "");
  EXPECT_EQ(Method("localized").options(Law::green).second_order, "");
  EXPECT_EQ(full.options(Law::biot).surface, localization::Surface::curved);
  EXPECT_EQ(Method("localized+modes").options(Law::biot).surface, localization::Surface::flat);
}

// `-micro` sets to zero what is added to the coarse motion, and leaves all that moves the coarse
// cloth, fitted modes of slip among it.
TEST(exact_method, without_micro_nothing_is_added_and_the_coarse_cloth_is_the_same)
{
  const Method less("full-micro");
  const localization::UpsamplerOptions options = less.options(Law::biot);
  EXPECT_FALSE(options.microscopic);
  EXPECT_EQ(options.second_order, "");
  EXPECT_EQ(options.anchor, localization::Anchor::lattice);
  EXPECT_EQ(Method("full").beyond(less), "micro");
  EXPECT_TRUE(less.has_fitted_modes(Law::yarn));
  EXPECT_EQ(less.rank(), 0);
}

TEST(exact_method, of_methods_with_the_same_terms_one_has_rows_presets_first)
{
  const std::vector<std::string> all = Method::defaults();
  EXPECT_EQ(distinct_methods(all, Law::biot, Load("strip-1")), all);
  const std::vector<std::string> infinite = {"affine", "localized", "full"};
  EXPECT_EQ(distinct_methods(all, Law::biot, Load("periodic-11")), infinite);
  EXPECT_EQ(distinct_methods(all, Law::linear, Load("periodic-11")),
            (std::vector<std::string>{"affine", "localized"}));
  EXPECT_EQ(distinct_methods({"affine", "full-micro"}, Law::yarn, Load("periodic-11")),
            std::vector<std::string>{"affine"}); // whose coarse motion is given
  EXPECT_EQ(distinct_methods({"affine", "full", "localized"}, Law::linear, Load("periodic-11")),
            (std::vector<std::string>{"affine", "localized"}));
  EXPECT_EQ(distinct_methods({"localized+p2", "localized+edges"}, Law::biot, Load("periodic-11")),
            std::vector<std::string>{"localized+p2"});
}

TEST(exact_method, the_one_with_most_terms_is_spoken_of)
{
  EXPECT_EQ(main_method({"affine", "full", "localized"}), "full");
  EXPECT_EQ(main_method({"full-micro", "localized", "localized+p2"}), "localized+p2");
  EXPECT_EQ(main_method({"localized+edges", "localized+p2"}), "localized+edges");
  EXPECT_EQ(main_method({"affine", "affine+p2", "full-micro"}), "localized");
  EXPECT_EQ(main_method({}), "localized");
}
