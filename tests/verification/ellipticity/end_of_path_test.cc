// SPDX-License-Identifier: MIT
#include "verification/ellipticity/end_of_path.h"

#include <gtest/gtest.h>

using namespace homespun::verification;

TEST(exact_end_of_path, it_is_a_limit_point_a_law_that_ends_the_solver_or_not_known)
{
  const PhaseEllipticity elliptic{8, 0, 0.4}, lost = together({elliptic, {8, 1, -0.6}});
  EXPECT_EQ(lost.n_triangles, 16);
  EXPECT_EQ(lost.n_lost, 1);
  EXPECT_EQ(lost.least, -0.6);
  const EndOnMesh turned{PathEnd::turned, 0.12, 1, elliptic},
    lost_on_the_way{PathEnd::turned, 0.12, 1, lost}, goes_on{PathEnd::reached, 0.3, 0, elliptic},
    stopped{PathEnd::lost, 0.1, 0, elliptic};
  EXPECT_EQ(ending_of(turned), Ending::limit_point);
  EXPECT_EQ(ending_of(lost_on_the_way), Ending::law);
  EXPECT_EQ(ending_of(goes_on), Ending::solver);
  EXPECT_EQ(ending_of(stopped), Ending::unknown);
  EXPECT_EQ(ending_of(EndOnMesh()), Ending::unknown);
  const auto says = [](const EndOnMesh &as_given, const EndOnMesh &refined, const char *words)
  {
    const std::string text = text_of(EndOfPath{4, as_given, refined});
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  says(turned, turned, "4 x 4 cells turns back at a strain of 12 %");
  says(turned, turned, ": a limit point");
  says(lost_on_the_way, lost_on_the_way, ": the law ends");
  says(goes_on, goes_on, ": there the equilibria go on");
  says(stopped, stopped, ": what ends it is not known");
  says(turned, lost_on_the_way, ": the two meshes end differently");
  says(goes_on, turned, ": the two meshes end differently");
  EXPECT_EQ(text_of(EndOfPath{4, {}, {}}).find("least wave"), std::string::npos);
}
