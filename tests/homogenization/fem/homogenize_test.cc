// SPDX-License-Identifier: MIT
#include "meshes/plain/symmetric_eigen.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace homespun;
using namespace homespun::homogenization;
using tests::relative_difference;
using tests::solved;

TEST(exact_homogenize, stripes_have_the_stiffness_of_the_closed_form_with_p1_and_p2)
{
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(1.), 6, 4, tests::soft_and_hard(), tests::halves);
  Eigen::Matrix3d published;
  published << 5.67982018, 0.599400599, 0., 0.599400599, 1.99800200, 0., 0., 0., 0.699300699;
  const Eigen::Matrix3d exact = laminate_stiffness(cell.stiffness_of_phase(), {0.5, 0.5});
  EXPECT_LT(relative_difference(exact, published), 1e-9);
  for (const unsigned int order : {1u, 2u})
  {
    const Homogenization result = solved(cell, order);
    EXPECT_LT(relative_difference(result.stiffness, exact), 1e-11) << "P" << order;
    EXPECT_LT(relative_difference(result.stiffness_by_flux, exact), 1e-10) << "P" << order;
    EXPECT_NEAR(result.stiffness(2, 2), exact(2, 2), 1e-11) << "P" << order;
  }
}

TEST(exact_homogenize, an_off_axis_anisotropic_laminate_has_all_nine_entries_of_its_closed_form)
{
  const std::vector<Phase> phases = {{"a", 10., 1., 0.3, 0.4, 30., 1., 1.},
                                     {"b", 6., 2., 0.2, 0.7, -55., 0.8, 1.},
                                     isotropic("c", 3., 0.1, 1.3, 1.)};
  // Layers of 1/4, 1/4 and 1/2.
  const UnitCell cell         = tests::cell_of(tests::square_lattice(0.01), 5, 8, phases,
                                               [](double, double f2) {
                                         return f2 < 0.25 ? 0 : f2 < 0.5 ? 1 : 2;
                                       });
  const Eigen::Matrix3d exact = laminate_stiffness(cell.stiffness_of_phase(), {0.25, 0.25, 0.5});
  ASSERT_GT(std::abs(exact(0, 2)), 0.1);
  ASSERT_GT(std::abs(exact(1, 2)), 0.05);
  for (const unsigned int order : {1u, 2u})
    EXPECT_LT(relative_difference(solved(cell, order).stiffness, exact), 1e-10) << "P" << order;
}

TEST(exact_homogenize, the_characteristic_displacements_of_stripes_are_those_of_the_laminate)
{
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(1.), 6, 4, tests::soft_and_hard(), tests::halves);
  const Eigen::Matrix3d C     = laminate_stiffness(cell.stiffness_of_phase(), {0.5, 0.5});
  const Homogenization result = solved(cell);
  // Under e_22 the layers stretch by C22 / c22; chi is what is missing: e_22 y − u.
  const double soft22  = cell.stiffness_of_phase()[0](1, 1);
  const double slope22 = 1. - C(1, 1) / soft22;
  const double slope12 = 1. - C(2, 2) / cell.stiffness_of_phase()[0](2, 2);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const double y = cell.mesh.vertices(v, 1), distance = y < 0.5 ? y : 1. - y;
    EXPECT_NEAR(result.chi(v, 3), slope22 * distance, 1e-11); // chi_22, component 2
    EXPECT_NEAR(result.chi(v, 4), slope12 * distance, 1e-11); // chi_12, component 1
    EXPECT_NEAR(result.chi(v, 0), 0., 1e-11);
    EXPECT_NEAR(result.chi(v, 5), 0., 1e-11);
  }
}

TEST(exact_homogenize, a_homogeneous_cell_keeps_its_stiffness_and_does_not_fluctuate)
{
  const Phase yarn{"yarn", 1e7, 1e6, 0.3, 4e5, 30., 5e-4, 400.};
  UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 7, 5, {yarn}, [](double, double) { return 0; });
  tests::shake(cell.mesh, cell.lattice, 3e-4);
  for (const unsigned int order : {1u, 2u})
  {
    const Homogenization result = solved(cell, order);
    EXPECT_LT(relative_difference(result.stiffness, plane_stress_stiffness(yarn)), 1e-12);
    EXPECT_EQ(result.chi.cwiseAbs().maxCoeff(), 0.);
    EXPECT_EQ(result.iterations, (std::array<unsigned int, 3>{0, 0, 0}));
  }
}

namespace
{
/// A pattern without symmetry, on a mesh of 8 x 8 squares.
int odd_pattern(const double f1, const double f2)
{
  const int i = static_cast<int>(8. * f1), j = static_cast<int>(8. * f2);
  return (i > 1 && i < 5 && j > 2 && j < 5) || (i == 4 && j > 4) ? 1 : 0;
}
} // namespace

TEST(invariant_homogenize, effective_stiffness_is_unchanged_when_the_cell_is_shifted)
{
  // Both diagonals of the squares are shifted with the pattern.
  const meshes::Lattice lattice = tests::skewed_lattice();
  const Eigen::Matrix3d before =
    solved(tests::cell_of(lattice, 8, 8, tests::soft_and_hard(), odd_pattern)).stiffness;
  for (const auto &[di, dj] : {std::pair(3, 0), std::pair(0, 5), std::pair(6, 7)})
  {
    UnitCell shifted =
      tests::cell_of(lattice, 8, 8, tests::soft_and_hard(),
                     [di = di, dj = dj](double f1, double f2) {
                       return odd_pattern(std::fmod(f1 + di / 8., 1.), std::fmod(f2 + dj / 8., 1.));
                     });
    EXPECT_LT(relative_difference(solved(shifted).stiffness, before), 1e-10);
    // And the same cell somewhere else in the plane.
    shifted.mesh.vertices.rowwise() += Eigen::RowVector2d(0.123, -0.456);
    EXPECT_LT(relative_difference(solved(shifted).stiffness, before), 1e-9);
  }
}

TEST(invariant_homogenize, effective_stiffness_is_unchanged_when_the_cell_is_doubled)
{
  const meshes::Lattice lattice = tests::skewed_lattice();
  const UnitCell one = tests::cell_of(lattice, 8, 8, tests::soft_and_hard(), odd_pattern);
  const UnitCell four =
    tests::cell_of({2. * lattice.vectors}, 16, 16, tests::soft_and_hard(),
                   [](double f1, double f2)
                   { return odd_pattern(std::fmod(2. * f1, 1.), std::fmod(2. * f2, 1.)); });
  for (const unsigned int order : {1u, 2u})
    EXPECT_LT(relative_difference(solved(four, order).stiffness, solved(one, order).stiffness),
              1e-10);
}

TEST(invariant_homogenize, effective_stiffness_does_not_know_the_unit_of_length)
{
  const meshes::Lattice lattice = tests::skewed_lattice();
  const Eigen::Matrix3d metres =
    solved(tests::cell_of(lattice, 8, 8, tests::soft_and_hard(), odd_pattern)).stiffness;
  for (const double scale : {1e-3, 1e3})
    EXPECT_LT(relative_difference(solved(tests::cell_of({scale * lattice.vectors}, 8, 8,
                                                        tests::soft_and_hard(), odd_pattern))
                                    .stiffness,
                                  metres),
              1e-11);
}

TEST(invariant_homogenize, effective_stiffness_scales_with_the_unit_of_stress)
{
  std::vector<Phase> phases     = tests::soft_and_hard();
  const meshes::Lattice lattice = tests::square_lattice(1.);
  const Eigen::Matrix3d in_pa =
    solved(tests::cell_of(lattice, 8, 8, phases, odd_pattern)).stiffness;
  for (Phase &phase : phases)
    phase = isotropic(phase.name, 1e9 * phase.E1, phase.nu12, 1., 1.);
  EXPECT_LT(relative_difference(
              solved(tests::cell_of(lattice, 8, 8, phases, odd_pattern)).stiffness / 1e9, in_pa),
            1e-11);
}

TEST(invariant_homogenize, a_turned_cell_has_the_turned_stiffness)
{
  UnitCell cell =
    tests::cell_of(tests::square_lattice(1.), 8, 8, tests::soft_and_hard(), odd_pattern);
  const Eigen::Matrix3d before = solved(cell).stiffness;
  for (const double degrees : {90., 30., -17.})
  {
    const double angle = degrees * M_PI / 180.;
    Eigen::Matrix2d turn; // acts on row vectors
    turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    UnitCell turned         = cell;
    turned.mesh.vertices    = cell.mesh.vertices * turn;
    turned.lattice.vectors  = cell.lattice.vectors * turn;
    const Eigen::Matrix3d T = stiffness_rotation(angle);
    EXPECT_LT(relative_difference(solved(turned).stiffness, T * before * T.transpose()), 1e-10)
      << degrees;
  }
}

TEST(invariant_homogenize, chi_is_zero_at_the_lattice_points_and_periodic)
{
  const UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 8, 8, tests::soft_and_hard(), odd_pattern);
  const Homogenization result = solved(cell, 2);
  EXPECT_GT(result.chi.cwiseAbs().maxCoeff(), 1e-5);
  const auto classes = meshes::match_images(cell.mesh.vertices, cell.lattice);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const int image = classes.representative[static_cast<std::size_t>(v)];
    EXPECT_EQ(result.chi.row(v), result.chi.row(image));
  }
  for (const int corner : {0, 8, 72, 80})
    EXPECT_EQ(result.chi.row(corner).cwiseAbs().maxCoeff(), 0.);
}

TEST(bound_homogenize, random_cells_lie_between_voigt_and_reuss)
{
  std::mt19937 generator(3);
  std::bernoulli_distribution coin(0.4);
  for (int k = 0; k < 4; ++k)
  {
    const UnitCell cell = tests::cell_of(tests::square_lattice(1.), 10, 10, tests::soft_and_hard(),
                                         [&](double, double) { return coin(generator) ? 1 : 0; });
    const Homogenization result = solved(cell);
    const auto smallest         = [](const Eigen::Matrix3d &m)
    { return meshes::symmetric_eigen<3>(m).values(0); };
    EXPECT_GT(smallest(result.voigt - result.stiffness), 0.);
    EXPECT_GT(smallest(result.stiffness - result.reuss), 0.);
    EXPECT_LT(relative_difference(result.stiffness_by_flux, result.stiffness), 1e-9);
  }
}

TEST(order_homogenize, equal_shear_moduli_converge_to_hills_exact_value_from_above)
{
  // Hill (1964): with one shear modulus G in all phases, any geometry has C66 = G and the area bulk
  // modulus K with 1/(K + G) = <1/(K_i + G)>.
  const double G = 1., K[2] = {1.5, 20.};
  std::vector<Phase> phases;
  for (const double bulk : K)
    phases.push_back(isotropic("p", 4. * bulk * G / (bulk + G), (bulk - G) / (bulk + G), 1., 1.));
  const double exact = 1. / (0.75 / (K[0] + G) + 0.25 / (K[1] + G)) - G;
  std::vector<double> errors;
  for (const int n : {8, 16, 32, 64})
  {
    const Eigen::Matrix3d C =
      solved(tests::cell_of(tests::square_lattice(1.), n, n, phases, tests::square_inclusion))
        .stiffness;
    errors.push_back(0.5 * (C(0, 0) + C(0, 1)) / exact - 1.);
    EXPECT_GT(errors.back(), 0.);
    EXPECT_GE(C(2, 2), G * (1. - 1e-12));
  }
  // At its corners the strain grows like log r, so the energy error is h^2 log(1/h).
  for (std::size_t k = 1; k < errors.size(); ++k)
  {
    const double n      = 8. * std::pow(2., static_cast<double>(k));
    const double theory = 2. - std::log2(std::log(n) / std::log(0.5 * n));
    EXPECT_NEAR(std::log2(errors[k - 1] / errors[k]), theory, 0.1) << "n = " << n;
  }
  EXPECT_LT(errors.back(), 1e-3);
}

TEST(exact_homogenize, direct_and_multigrid_solvers_agree_on_stiffness_and_displacements)
{
  for (const unsigned int order : {1u, 2u})
    for (const double contrast : {10., 1e6})
    {
      std::vector<Phase> phases = tests::soft_and_hard();
      phases[1]                 = isotropic("hard", contrast, 0.3, 1., 1.);
      const UnitCell cell =
        tests::cell_of(tests::skewed_lattice(), 64, 64, phases, tests::square_inclusion);
      HomogenizationOptions options;
      options.order                   = order;
      const Homogenization of_fastest = homogenize(cell, options, MPI_COMM_SELF);
      options.solver                  = CellSolver::direct;
      const Homogenization direct     = homogenize(cell, options, MPI_COMM_SELF);
      options.solver                  = CellSolver::multigrid;
      const Homogenization multigrid  = homogenize(cell, options, MPI_COMM_SELF);
      EXPECT_EQ(of_fastest.solver, CellSolver::direct); // on one rank, of a small cell
      EXPECT_EQ(direct.solver, CellSolver::direct);
      EXPECT_EQ(multigrid.solver, CellSolver::multigrid);
      for (const unsigned int iterations : direct.iterations)
        EXPECT_LE(iterations, 3u); // one, and what round-off at this contrast costs
      for (const unsigned int iterations : multigrid.iterations)
        EXPECT_GT(iterations, 5u); // several levels
      // Each leaves 1e-9 of the displacements in the energy norm as its preconditioner measures it,
      // whose root of the condition is at most ten; in C^H that is squared. Besides, a stiff
      // inclusion moves as a whole by what the sums of its large forces lose, however small the
      // tolerance: per row of nodes a rounding of the absolute sum of a row of the matrix, of some
      // eight stiffnesses, against the stiffness of what holds it.
      const double lost = 8. * 64. * order * std::numeric_limits<double>::epsilon() * contrast;
      EXPECT_LT(relative_difference(direct.stiffness, multigrid.stiffness), 1e-10);
      EXPECT_LT((direct.chi - multigrid.chi).norm(), 2. * (1e-8 + lost) * multigrid.chi.norm());
    }
}

// At 1e8 the soft phases hold a part of 1e-8 of the energy, to be solved as exactly: half as many
// digits more.
TEST(invariant_homogenize, iterations_hardly_grow_with_contrast)
{
  std::vector<unsigned int> iterations;
  for (const double contrast : {10., 1e4, 1e8})
  {
    std::vector<Phase> phases = tests::soft_and_hard();
    phases[1]                 = isotropic("hard", contrast, 0.3, 1., 1.);
    HomogenizationOptions options;
    options.order  = 1;
    options.solver = CellSolver::multigrid;
    const auto result =
      homogenize(tests::cell_of(tests::square_lattice(1.), 64, 64, phases, odd_pattern), options,
                 MPI_COMM_SELF);
    iterations.push_back(*std::max_element(result.iterations.begin(), result.iterations.end()));
  }
  EXPECT_LT(iterations[1], 1.5 * iterations[0]);
  EXPECT_LT(iterations[2], 1.75 * iterations[0]);
}
