// SPDX-License-Identifier: MIT
#include "verification/laws/end_of_path.h"

#include <gtest/gtest.h>

using namespace homespun::verification;

TEST(exact_end_of_path, it_is_a_limit_point_a_law_that_ends_or_the_solver)
{
  const EndOnMesh turned{PathEnd::turned, 0.12, 1, 0.4},
    lost_on_the_way{PathEnd::turned, 0.12, 1, -0.6}, goes_on{PathEnd::reached, 0.3, 0, 0.4},
    stopped{PathEnd::lost, 0.1, 0, 0.4};
  EXPECT_EQ(ending_of(turned), Ending::limit_point);
  EXPECT_EQ(ending_of(lost_on_the_way), Ending::law);
  EXPECT_EQ(ending_of(goes_on), Ending::solver);
  EXPECT_EQ(ending_of(stopped), Ending::solver);
  const std::string text = text_of(EndOfPath{4, turned, lost_on_the_way});
  EXPECT_NE(text.find("4 x 4 cells turns back at a strain of 12 %"), std::string::npos) << text;
  EXPECT_NE(text.find(": a limit point"), std::string::npos) << text;
  EXPECT_NE(text_of(EndOfPath{4, lost_on_the_way, turned}).find("the law ends"), std::string::npos);
  EXPECT_NE(text_of(EndOfPath{4, goes_on, turned}).find("the equilibria go on"), std::string::npos);
}
