// SPDX-License-Identifier: MIT
// The static sag of a sheet clamped on four sides: the shell's equilibrium held against the
// finite-element reference of the same homogenized sheet, two codes that share nothing.
#include "meshes/plain/sheet.h"
#include "shell/solver/cloth.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "verification/reference/cloth_reference.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double side = 0.2, density = 0.2;

Eigen::Matrix3d layered()
{
  Eigen::Matrix3d C;
  C << 2839.9, 299.7, 0., 299.7, 999., 0., 0., 0., 349.65;
  return C;
}

meshes::TriangleMesh sheet_of(const int n)
{
  meshes::TriangleMesh mesh =
    meshes::coarse_sheet(Eigen::RowVector2d::Zero(), side / n * Eigen::Matrix2d::Identity(), n, n);
  mesh.material = Eigen::VectorXi::Zero(mesh.n_triangles());
  return mesh;
}

/// Height of the middle [m].
double sag_of_shell(const int n)
{
  const meshes::ClothMesh mesh = meshes::placed_sheet(
    sheet_of(n), Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
  const Eigen::VectorXd masses = shell::lumped_masses(mesh, {density});
  shell::Cloth cloth(mesh.positions, masses, meshes::boundary_loops(mesh.rest).at(0));
  cloth.add(shell::membrane_term(mesh, {layered()}));
  cloth.add(shell::gravity_term(masses, {0., 0., -9.81}));
  cloth.solve_equilibrium(1e-9);
  return cloth.positions()(n / 2 * (n + 1) + n / 2, 2);
}

double sag_of_reference(const int n, const unsigned int order)
{
  const meshes::TriangleMesh mesh = sheet_of(n);
  ClothReferenceOptions options;
  options.order           = order;
  options.consistent_mass = order == 2;
  ClothReference reference(mesh, {layered()}, {density}, options, MPI_COMM_WORLD);
  const auto lying = [](const Eigen::RowVector2d &X) { return Eigen::RowVector3d(X(0), X(1), 0.); };
  reference.start(lying,
                  [&](const Eigen::RowVector2d &X, double) -> std::optional<Eigen::RowVector3d>
                  {
                    const double edge = 1e-9;
                    if (X.minCoeff() < edge || X.maxCoeff() > side - edge)
                      return lying(X);
                    return std::nullopt;
                  },
                  {{0., 0., -9.81}, 0.});
  const ClothStep step = reference.solve_equilibrium(0.);
  EXPECT_TRUE(step.reached) << step.why;
  return reference.positions()(n / 2 * (n + 1) + n / 2, 2);
}
} // namespace

TEST(exact_clamped_sheet, the_shell_and_the_reference_agree_within_their_error_bars)
{
  // The same mesh is the same discrete problem.
  const double coarse = sag_of_shell(10), fine = sag_of_shell(20);
  EXPECT_NEAR(fine, sag_of_reference(20, 1), 1e-6 * std::abs(fine));
  // P1 is of second order: its error bar is a third of the last difference; P2 has its own.
  const double bar = std::abs(fine - coarse) / 3., p2 = sag_of_reference(20, 2),
               bar_of_p2 = std::abs(p2 - sag_of_reference(10, 2));
  EXPECT_LT(std::abs(fine - p2), 1.5 * bar + bar_of_p2);
  EXPECT_LT(bar, 0.02 * std::abs(fine));
  RecordProperty("sag_mm", std::to_string(1e3 * p2));
  std::printf("sag at the middle: shell 20 x 20 %.6f mm (bar %.6f), P2 %.6f mm (bar %.6f)\n",
              1e3 * fine, 1e3 * bar, 1e3 * p2, 1e3 * bar_of_p2);
}
