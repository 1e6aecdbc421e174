// SPDX-License-Identifier: MIT
// What is made of triangles refuses the same ones for having no area, each in its own words.
#include "meshes/cloth/cloth_faults.h"
#include "meshes/plain/triangle_mesh.h"
#include "shell/contact/closed_surface.h"
#include "shell/membrane/membrane.h"
#include "shell/terms/hinges.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

using namespace homespun;
using tests::refusal;

namespace
{
meshes::TriangleMesh needle(const double height)
{
  meshes::TriangleMesh mesh;
  mesh.vertices.resize(3, 2);
  mesh.vertices << 0., 0., 0.2, 0., 0.1, 0.2 * height;
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  mesh.material = Eigen::VectorXi::Zero(1);
  return mesh;
}

meshes::ClothMesh cloth(const double height)
{
  return meshes::placed_sheet(needle(height), Eigen::Matrix<double, 3, 2>::Identity(),
                              Eigen::RowVector3d::Zero());
}

/// A tetrahedron on a needle.
meshes::Surface solid(const double height)
{
  meshes::Surface surface;
  surface.positions.resize(4, 3);
  surface.positions << 0., 0., 0., 1., 0., 0., 0.5, height, 0., 0.5, 0.3, 1.;
  surface.triangles.resize(4, 3);
  surface.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  return surface;
}

std::string all(const std::vector<std::string> &faults)
{
  std::string text;
  for (const std::string &fault : faults)
    text += fault + '\n';
  return text;
}

/// What each says to a triangle so high over its longest edge.
std::vector<std::string> answers(const double height)
{
  const meshes::Surface surface = solid(height);
  return {
    all(meshes::faults_of(needle(height), "cell")),
    all(meshes::cloth_faults(cloth(height), "cloth")),
    all(meshes::surface_faults(surface, "solid")),
    refusal([&]() { shell::membrane(needle(height), {Eigen::Matrix3d::Identity()}); }),
    refusal([&]()
            { shell::hinges_of(cloth(height), {shell::PlateStiffness::isotropic(1., 0.3)}); }),
    refusal([&]() { shell::ClosedSurface(surface.positions, surface.triangles, "solid"); })};
}
} // namespace

TEST(tripwire_flat_triangles, all_refuse_the_same_ones_in_their_own_words)
{
  const std::vector<std::string> words = {
    "triangle 0 near (0, 0) m has area 1.8e-11 m^2 with a longest edge of 0.2 m; expected a proper "
    "triangle",
    "triangle 0 near the rest point (0, 0) m has no area at rest: it is 9e-10 times as high as its "
    "longest edge of 0.2 m is long",
    "triangle 0 near (0, 0, 0) m has no area: it is 9e-10 times as high as its longest edge of 1 m",
    "triangle 0: has area 1.8e-11 m^2 at rest (longest side 0.2 m); expected a counter-clockwise "
    "triangle of positive area",
    "triangle 0 has area 1.8e-11 m^2 at rest; expected a counter-clockwise triangle of positive "
    "area",
    "triangle 0 has no area; remove it"};
  const std::vector<std::string> refused = answers(0.9e-9), taken = answers(1.1e-9);
  for (std::size_t k = 0; k < words.size(); ++k)
  {
    EXPECT_NE(refused[k].find(words[k]), std::string::npos) << words[k] << "\nfound\n"
                                                            << refused[k];
    EXPECT_EQ(taken[k].find("area"), std::string::npos) << taken[k]; // it may have other faults
  }
}
