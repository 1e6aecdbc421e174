// SPDX-License-Identifier: MIT
// The answer does not depend on the number of ranks.
#include "tests/verification/reference/cloth_reference_cases.h"

#include <gtest/gtest.h>

#include <tuple>

using namespace homespun;
using namespace homespun::tests;

/// Run under mpiexec by ctest; alone it compares one rank with itself.
TEST(ranks_cloth_reference, one_rank_and_all_ranks_give_the_same_positions)
{
  meshes::TriangleMesh mesh = rectangle(0.2, 0.2, 12, 12, 0.15);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    mesh.material(t) = (t / 6) % 2;
  const Held sides = [](const Eigen::RowVector2d &X,
                        const double t) -> std::optional<Eigen::RowVector3d>
  {
    if (X.minCoeff() < 1e-9 || X.maxCoeff() > 0.2 - 1e-9)
      return Eigen::RowVector3d(1.05 * X(0), 1.05 * X(1), X(0) * t);
    return std::nullopt;
  };
  ClothLoads loads;
  loads.gravity = {0., 0., -g};
  for (const Law law : {Law::biot, Law::green})
    for (const unsigned int order : {1u, 2u})
    {
      const auto solve = [&](const MPI_Comm communicator, const bool is_static)
      {
        ClothReference cloth(mesh, {anisotropic(), 10. * anisotropic()}, {0.2, 0.3},
                             options_of(law, order, true, 1e-12), communicator);
        cloth.start([](const Eigen::RowVector2d &X)
                    { return Eigen::RowVector3d(1.05 * X(0), 1.05 * X(1), 0.); },
                    sides, loads);
        for (int n = 0; n < (is_static ? 1 : 2); ++n)
        {
          const ClothStep step = is_static ? cloth.solve_equilibrium(0.) : cloth.step(0.01);
          EXPECT_TRUE(step.reached) << step.why;
        }
        return std::make_tuple(cloth.positions(), cloth.stored_energy(), cloth.kinetic_energy());
      };
      for (const bool is_static : {false, true})
      {
        const auto [here, stored, kinetic]              = solve(MPI_COMM_SELF, is_static);
        const auto [there, stored_there, kinetic_there] = solve(MPI_COMM_WORLD, is_static);
        EXPECT_LT(largest_distance(here, there), 1e-10 * 0.2) << name_of(law) << order << is_static;
        EXPECT_NEAR(stored_there, stored, 1e-10 * stored);
        EXPECT_NEAR(kinetic_there, kinetic, 1e-10 * kinetic);
      }
    }
}
