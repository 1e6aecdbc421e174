// SPDX-License-Identifier: MIT
#include "meshes/files/frame_caches.h"
#include "tests/content_of.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>

#include <unistd.h>

using namespace homespun::meshes;
using homespun::tests::content_of;
using homespun::tests::refusal;

namespace
{
std::string place(const std::string &name)
{
  return (std::filesystem::temp_directory_path() /
          ("homespun-frames-" + std::to_string(::getpid()) + "-" + name))
    .string();
}

const FloatPoints points =
  (FloatPoints(4, 3) << 0, 0, 0.1, 1, 0, -0.25, 0, 2, 1e-9, 1, 2, 0).finished();
const Triangles triangles = (Triangles(2, 3) << 0, 1, 2, 2, 1, 3).finished();
} // namespace

TEST(exact_frame_caches, a_point_cache_holds_its_head_and_every_frame)
{
  const std::string file = place("a.pc2");
  {
    PointCache cache(file, 4, 2);
    cache.append(points);
    cache.append(2.f * points);
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_NE(
      refusal([&] { cache.append(points.topRows(3)); }).find("a frame has 3 vertices; expected 4"),
      std::string::npos);
    cache.finish();
  }
  const std::string bytes = content_of(file);
  ASSERT_EQ(bytes.size(), 32u + 2u * 48u);
  EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2", 12));
  std::array<std::int32_t, 2> head{};
  std::memcpy(head.data(), bytes.data() + 12, 8);
  EXPECT_EQ(head, (std::array<std::int32_t, 2>{1, 4}));
  std::int32_t n_frames = 0;
  std::memcpy(&n_frames, bytes.data() + 28, 4);
  EXPECT_EQ(n_frames, 2);
  float last = 0.f;
  std::memcpy(&last, bytes.data() + 32 + 48 + 4 * 10, 4); // y of the last vertex, second frame
  EXPECT_EQ(last, 4.f);
}

TEST(exact_frame_caches, usd_has_positions_over_time_and_a_subset_with_a_material_for_each_phase)
{
  const std::string file = place("a.usda");
  const ClothLook look = ClothLook::of((Points(4, 2) << 0., 0., 1., 0., 0., 2., 1., 2.).finished(),
                                       triangles, Eigen::Vector2i(1, 0));
  UsdAnimation animation(file, 4, triangles, look, {UpAxis::y, 2});
  animation.append(points);
  animation.append(2.f * points);
  animation.finish();
  const std::string text = content_of(file);
  for (const char *part :
       {"endTimeCode = 1\n", "timeCodesPerSecond = 24\n", "upAxis = \"Y\"",
        "int[] faceVertexIndices = [0, 1, 2, 2, 1, 3]\n",
        "texCoord2f[] primvars:st = [(0, 0), (0.5, 0), (0, 1), (0, 1), (0.5, 0), (0.5, 1)] (",
        "def GeomSubset \"phase_1\"",
        "int[] indices = [0]\n            rel material:binding = "
        "</cloth/materials/phase_1>",
        "            1: [(0, 0, 0.2), (2, 0, -0.5), (0, 4, 2e-09), (2, 4, 0)],\n",
        "            0: [(0, 0, -0.25), (1, 2, 0.1)],\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(tripwire_frame_caches, what_is_not_finite_or_not_finished_leaves_no_file)
{
  const std::string file = place("b.usda");
  FloatPoints bad        = points;
  bad(1, 1)              = std::numeric_limits<float>::quiet_NaN();
  {
    UsdAnimation animation(file, 4, triangles, {}, {UpAxis::z, 1});
    EXPECT_NE(
      refusal([&] { animation.append(bad); }).find("vertex 1 has a position that is not finite"),
      std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
  const Triangles beyond = (Triangles(1, 3) << 0, 1, 4).finished();
  EXPECT_NE(refusal(
              [&] {
                UsdAnimation(file, 4, beyond, {}, {UpAxis::z, 1});
              })
              .find("a triangle names a vertex that does not exist; expected 0 to 3"),
            std::string::npos);
}
