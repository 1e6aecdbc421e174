// SPDX-License-Identifier: MIT
// Sound and unsound meshes, taken the way of the program: faults first, then a cloth.
#include "meshes/cloth/cloth_faults.h"
#include "meshes/plain/errors.h"
#include "shell/terms/membrane_term.h"
#include "tests/verification/stress/checks.h"
#include "verification/stress/stress_sheet.h"

#include <limits>

using namespace homespun;
using namespace homespun::verification;
using meshes::ClothMesh;
using meshes::TriangleMesh;
using shell::Cloth;
using tests::expect_refused;
using tests::expect_within;

namespace
{
constexpr int n_coarse = 4; ///< cells per side of the sheet

ClothMesh placed(const TriangleMesh &rest,
                 const Eigen::RowVector3d &origin = Eigen::RowVector3d::Zero())
{
  Eigen::Matrix<double, 3, 2> placement;
  placement << 1., 0., 0., 0., 0., 1.;
  return meshes::placed_sheet(rest, placement, origin);
}

void refuse_faults(const ClothMesh &mesh)
{
  const std::vector<std::string> faults = meshes::cloth_faults(mesh, "sheet");
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

/// The mesh hung by its vertex of highest index, with gravity.
StressAnswer hang(const ClothMesh &mesh, const SheetStiffness &stiffness)
{
  refuse_faults(mesh);
  Cloth cloth         = sheet_cloth(mesh, stiffness, {mesh.n_vertices() - 1});
  const double growth = largest_energy_growth(cloth, 0.005, 60);
  return {growth, state_of(cloth)};
}

TriangleMesh with_triangle(TriangleMesh mesh, const Eigen::RowVector3i &corners)
{
  const int m = mesh.n_triangles();
  mesh.triangles.conservativeResize(m + 1, 3);
  mesh.triangles.row(m) = corners;
  mesh.material.conservativeResize(m + 1);
  mesh.material(m) = 0;
  return mesh;
}

TriangleMesh with_vertex(TriangleMesh mesh, const Eigen::RowVector2d &vertex)
{
  const int v = mesh.n_vertices();
  mesh.vertices.conservativeResize(v + 1, 2);
  mesh.vertices.row(v) = vertex;
  return mesh;
}

/// Without the triangles that the predicate names.
template <typename Predicate>
TriangleMesh without(const TriangleMesh &mesh, const Predicate &is_gone)
{
  TriangleMesh left;
  left.vertices = mesh.vertices;
  left.triangles.resize(mesh.n_triangles(), 3);
  int count = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    if (!is_gone(t))
      left.triangles.row(count++) = mesh.triangles.row(t);
  left.triangles.conservativeResize(count, 3);
  left.material = Eigen::VectorXi::Zero(count);
  return left;
}

TriangleMesh made_of(const std::vector<Eigen::RowVector2d> &vertices,
                     const std::vector<Eigen::RowVector3i> &triangles)
{
  TriangleMesh mesh;
  for (const auto &vertex : vertices)
    mesh = with_vertex(mesh, vertex);
  for (const auto &corners : triangles)
    mesh = with_triangle(mesh, corners);
  return mesh;
}

TriangleMesh turned_around(TriangleMesh mesh, const int triangle)
{
  std::swap(mesh.triangles(triangle, 1), mesh.triangles(triangle, 2));
  return mesh;
}

/// The upper left vertex, which one triangle has, brought near to the middle of the opposite edge.
TriangleMesh with_sliver(TriangleMesh mesh, const double height)
{
  const int corner = n_coarse * (n_coarse + 1), below = corner - (n_coarse + 1), right = corner + 1;
  const Eigen::RowVector2d edge = mesh.vertices.row(right) - mesh.vertices.row(below);
  mesh.vertices.row(corner)     = 0.5 * (mesh.vertices.row(right) + mesh.vertices.row(below)) +
                              height * Eigen::RowVector2d(-edge(1), edge(0));
  return mesh;
}

} // namespace

TEST(bound_stress, unsound_meshes_are_refused)
{
  const SheetStiffness stiffness = built_in_stiffnesses()[0];
  const TriangleMesh sheet       = meshes::irregular_sheet(n_coarse, 0.2);
  const int m = sheet.n_triangles(), v = sheet.n_vertices(),
            sliver   = 2 * (n_coarse - 1) * n_coarse + 1;
  const auto refused = [&](const std::string &name, const std::string &names, const ClothMesh &mesh)
  { expect_refused(name, names, [&]() { hang(mesh, stiffness); }); };
  const std::string last = "triangle " + std::to_string(m);
  refused("rest triangle without area", "triangle " + std::to_string(sliver),
          placed(with_sliver(sheet, 0.)));
  expect_refused("rest triangle without area; straight to the membrane",
                 "triangle " + std::to_string(sliver),
                 [&]() { shell::membrane_term(placed(with_sliver(sheet, 0.)), {stiffness.D}); });
  refused("duplicate triangle", last + " repeats triangle 5",
          placed(with_triangle(sheet, sheet.triangles.row(5))));
  refused("T-junction", "T-junction",
          placed(made_of({{0., 0.}, {.1, 0.}, {.1, .1}, {0., .1}, {.2, 0.}, {.2, .1}, {.1, .05}},
                         {{0, 1, 2}, {0, 2, 3}, {1, 4, 6}, {4, 5, 6}, {6, 5, 2}})));
  refused("edge of three triangles", "belongs to 3 triangles",
          placed(with_triangle(with_vertex(sheet, {0.3, 0.3}), {0, n_coarse + 2, v})));
  refused("isolated vertex", "vertex " + std::to_string(v), placed(with_vertex(sheet, {0.3, 0.3})));
  refused("one triangle turned around", "triangle 5", placed(turned_around(sheet, 5)));
  TriangleMesh flipped = sheet;
  for (int t = 0; t < m; ++t)
    flipped = turned_around(flipped, t);
  refused("all triangles turned around", "mirrored", placed(flipped));
  refused("no triangle", "no triangle", placed(without(sheet, [](int) { return true; })));
  refused("index out of range", "names rest vertex 99",
          [&]()
          {
            ClothMesh mesh            = placed(sheet);
            mesh.rest.triangles(3, 1) = 99;
            return mesh;
          }());
  refused("vertex that is not a number", "vertex 7",
          [&]()
          {
            ClothMesh mesh       = placed(sheet);
            mesh.positions(7, 0) = std::numeric_limits<double>::quiet_NaN();
            return mesh;
          }());
}

TEST(bound_stress, sound_meshes_hang)
{
  const SheetStiffness stiffness = built_in_stiffnesses()[0];
  const TriangleMesh sheet       = meshes::irregular_sheet(n_coarse, 0.2);
  const auto finite              = [&](const std::string &name, const ClothMesh &mesh)
  { expect_within(name, energy_round_off, [&](unsigned int) { return hang(mesh, stiffness); }); };
  finite("one triangle", placed(made_of({{0., 0.}, {.1, 0.}, {0., .1}}, {{0, 1, 2}})));
  finite("two triangles",
         placed(made_of({{0., 0.}, {.1, 0.}, {.1, .1}, {0., .1}}, {{0, 1, 2}, {0, 2, 3}})));
  const int hole = 2 * (n_coarse + 1);
  finite("a hole", placed(without(sheet, [=](const int t) { return t / 2 == hole / 2; })));
  finite("sliver; 1e-6 as high as long", placed(with_sliver(sheet, 1e-6)));
  finite("seen from the other side",
         [&]()
         {
           ClothMesh mesh        = placed(sheet);
           mesh.positions.col(0) = -mesh.positions.col(0);
           return mesh;
         }());

  TriangleMesh far          = sheet;
  constexpr double distance = 1e4; // [m]
  far.vertices.array() += distance;
  const ClothMesh far_away = placed(far, {0., distance, 0.});
  finite("origin at 1e4 m", far_away);
  constexpr int n_steps = 1000;
  // A sheet at rest stays; half a unit in the last place of 1e4 m, 1e-12 m, in each step.
  expect_within("origin at 1e4 m; 1000 steps at rest",
                n_steps * 0.5 * std::numeric_limits<double>::epsilon() * distance,
                [&](unsigned int) -> StressAnswer
                {
                  SheetPhysics weightless;
                  weightless.gravity.setZero();
                  Cloth cloth = sheet_cloth(far_away, stiffness, {}, weightless);
                  for (int k = 0; k < n_steps; ++k)
                    cloth.step(0.01);
                  return {(cloth.positions() - far_away.positions).rowwise().norm().maxCoeff(),
                          state_of(cloth)};
                });
}
