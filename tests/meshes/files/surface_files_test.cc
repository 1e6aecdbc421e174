// SPDX-License-Identifier: MIT
#include "meshes/files/surface_files.h"
#include "meshes/plain/errors.h"
#include "tests/content_of.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>

#include <unistd.h>

using namespace homespun;
using namespace homespun::meshes;
using homespun::tests::content_of;
using homespun::tests::refusal;

namespace
{
/// A folder that goes away.
struct TemporaryFolder
{
  TemporaryFolder()
      : path(std::filesystem::temp_directory_path() /
             ("homespun-files-" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(path);
  }
  ~TemporaryFolder()
  {
    std::filesystem::remove_all(path);
  }
  std::string file(const std::string &name) const
  {
    return (path / name).string();
  }
  std::filesystem::path path;
};

template <typename Number>
Number number_at(const std::string &bytes, const std::size_t place)
{
  Number number;
  std::memcpy(&number, bytes.data() + place, sizeof(number));
  return number;
}

struct Sample
{
  FloatPoints positions = (FloatPoints(4, 3) << 0, 0, 0, 1, 0, 0, 1, 1, 0.5, 0, 1, 0.25).finished();
  Triangles triangles   = (Triangles(2, 3) << 0, 1, 2, 0, 2, 3).finished();
  VertexData scalar     = {"strain", Eigen::Vector4f(0.5f, 1.f, 1.5f, -2.f)};
  VertexData vector     = {"u <m> & \"more\"", Eigen::Matrix<float, 4, 3>::Constant(3.f)};
};
} // namespace

TEST(exact_surface_files, a_ply_holds_header_floats_and_faces_byte_by_byte)
{
  const TemporaryFolder folder;
  const Sample sample;
  write_ply(folder.file("a.ply"), sample.positions, sample.triangles);
  const std::string text = content_of(folder.file("a.ply"));
  const std::size_t body = text.find("end_header\n") + 11;
  EXPECT_NE(text.find("format binary_little_endian 1.0\n"), std::string::npos);
  EXPECT_NE(text.find("element vertex 4\n"), std::string::npos);
  EXPECT_NE(text.find("element face 2\n"), std::string::npos);
  ASSERT_EQ(text.size(), body + 4 * 12 + 2 * 13);
  EXPECT_EQ(number_at<float>(text, body + 2 * 12 + 8), 0.5f); // z of vertex 2
  EXPECT_EQ(text[body + 48 + 13], '\3');
  EXPECT_EQ(number_at<int>(text, body + 48 + 13 + 1 + 8), 3);
}

TEST(exact_surface_files, a_ply_of_cloth_has_normals_texture_and_the_phase_as_number_and_colour)
{
  const TemporaryFolder folder;
  const Sample sample;
  // A flat cloth of 2 m by 1 m whose second triangle has corners of its own, as at a seam.
  Points rest(6, 2);
  rest << 1., 1., 3., 1., 3., 2., 1., 1., 3., 2., 1., 2.;
  const ClothLook look =
    ClothLook::of(rest, (Triangles(2, 3) << 0, 1, 2, 3, 4, 5).finished(), Eigen::Vector2i(0, 1));
  EXPECT_EQ(look.texture.row(2), Eigen::RowVector2d(1., 0.5));
  FloatPoints normals = FloatPoints::Zero(4, 3);
  normals.col(2).setOnes();
  write_ply(folder.file("a.ply"), sample.positions, sample.triangles, look, normals);
  const std::string text = content_of(folder.file("a.ply"));
  const std::size_t body = text.find("end_header\n") + 11;
  for (const char *word :
       {"property float nx\n", "property float s\nproperty float t\n",
        "property int material\nproperty uchar red\n", "property list uchar float texcoord\n"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
  constexpr std::size_t of_vertex = 12 + 12 + 8 + 3, of_face = 13 + 4 + 3 + 1 + 24;
  ASSERT_EQ(text.size(), body + 4 * of_vertex + 2 * of_face);
  const auto byte = [&](const std::size_t place)
  { return static_cast<int>(static_cast<unsigned char>(text[place])); };
  EXPECT_EQ(number_at<float>(text, body + 20), 1.f);                  // nz of vertex 0
  EXPECT_EQ(number_at<float>(text, body + of_vertex + 24), 1.f);      // s of vertex 1
  EXPECT_EQ(number_at<float>(text, body + 3 * of_vertex + 28), 0.5f); // t of vertex 3
  EXPECT_EQ(byte(body + of_vertex + 32), 230);                        // red of vertex 1: phase 0
  EXPECT_EQ(byte(body + 32), (230 + 86) / 2);                         // of vertex 0: both
  const std::size_t second = body + 4 * of_vertex + of_face;
  EXPECT_EQ(number_at<int>(text, second + 13), 1);
  EXPECT_EQ(byte(second + 13 + 4 + 2), 233);                             // blue of phase 1
  EXPECT_EQ(number_at<float>(text, second + 13 + 4 + 3 + 1 + 20), 0.5f); // t of its last corner

  ClothLook wrong   = look;
  wrong.material(1) = -1;
  EXPECT_NE(
    refusal([&] { write_ply(folder.file("b.ply"), sample.positions, sample.triangles, wrong); })
      .find("phases or texture coordinates do not belong to its triangles"),
    std::string::npos);
}

TEST(exact_surface_files, a_vtu_says_where_each_array_begins_and_how_long_it_is)
{
  const TemporaryFolder folder;
  const Sample sample;
  write_vtu(folder.file("a.vtu"), sample.positions, sample.triangles,
            {sample.scalar, sample.vector});
  const std::string text = content_of(folder.file("a.vtu"));
  EXPECT_NE(text.find("NumberOfPoints=\"4\" NumberOfCells=\"2\""), std::string::npos);
  EXPECT_NE(text.find("Name=\"u &lt;m&gt; &amp; &quot;more&quot;\" NumberOfComponents=\"3\""),
            std::string::npos);
  const std::size_t data          = text.find("<AppendedData encoding=\"raw\">\n_") + 31;
  const std::vector<int> expected = {4 * 4, 4 * 12, 4 * 12, 2 * 12, 2 * 8, 2};
  std::size_t place = 0, search = 0;
  for (const int bytes : expected)
  {
    search = text.find("offset=\"", search) + 8;
    EXPECT_EQ(std::stoul(text.substr(search)), place);
    EXPECT_EQ(number_at<std::uint64_t>(text, data + place), static_cast<std::uint64_t>(bytes));
    place += 8 + static_cast<std::size_t>(bytes);
  }
  EXPECT_EQ(text.substr(data + place), "\n</AppendedData>\n</VTKFile>\n");
  EXPECT_EQ(number_at<float>(text, data + 8 + 3 * 4), -2.f);
}

TEST(invariant_surface_files, a_collection_is_complete_after_every_frame)
{
  const TemporaryFolder folder;
  FrameCollection frames(folder.file("a.pvd"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("a.pvd")));
  for (int k = 0; k < 3; ++k)
  {
    frames.append(0.25 * k, "a-" + std::to_string(k) + ".vtu");
    const std::string text = content_of(folder.file("a.pvd"));
    EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
    std::size_t n = 0;
    for (std::size_t at = text.find("<DataSet "); at != std::string::npos;
         at             = text.find("<DataSet ", at + 1))
      ++n;
    EXPECT_EQ(n, static_cast<std::size_t>(k + 1));
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.pvd.part")));
  }
}

TEST(tripwire_surface_files, numbers_that_are_not_finite_reach_no_file_and_the_old_one_stays)
{
  const TemporaryFolder folder;
  const Sample good;
  const std::string ply = folder.file("a.ply"), vtu = folder.file("a.vtu");
  write_ply(ply, good.positions, good.triangles);
  write_vtu(vtu, good.positions, good.triangles);
  const std::string old_ply = content_of(ply), old_vtu = content_of(vtu);
  Sample bad;
  bad.positions(2, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal([&] { write_ply(ply, bad.positions, bad.triangles); })
              .find("a.ply: not written: vertex 2 has a position that is not finite"),
            std::string::npos);
  bad                     = good;
  bad.scalar.values(3, 0) = std::numeric_limits<float>::infinity();
  EXPECT_NE(refusal([&] { write_vtu(vtu, bad.positions, bad.triangles, {bad.scalar}); })
              .find("`strain` is not finite at vertex 3"),
            std::string::npos);
  bad                 = good;
  bad.triangles(1, 1) = 4;
  EXPECT_NE(refusal([&] { write_vtu(vtu, bad.positions, bad.triangles); })
              .find("names vertex 4; expected 0 to 3"),
            std::string::npos);
  FrameCollection frames(folder.file("a.pvd"));
  EXPECT_NE(refusal([&] { frames.append(std::nan(""), "a.vtu"); }).find("is not finite"),
            std::string::npos);
  EXPECT_NE(refusal([&] { write_ply("/nowhere/a.ply", good.positions, good.triangles); })
              .find("/nowhere/a.ply: cannot be written"),
            std::string::npos);
  EXPECT_EQ(content_of(ply), old_ply);
  EXPECT_EQ(content_of(vtu), old_vtu);
}
