// SPDX-License-Identifier: MIT
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
const std::vector<Law> laws = {Law::biot, Law::green};

Homogenization with_second_order(const UnitCell &cell, const unsigned int order = 1)
{
  HomogenizationOptions options;
  options.order        = order;
  options.tolerance    = 1e-13;
  options.solver       = order == 1 ? CellSolver::multigrid : CellSolver::direct;
  options.second_order = laws;
  return homogenize(cell, options, MPI_COMM_SELF);
}

/// A pattern without symmetry, of phases with axes of their own.
UnitCell odd_cell()
{
  return tests::cell_of(tests::skewed_lattice(), 8, 8,
                        {{"a", 10., 1., 0.3, 0.4, 30., 1., 1.}, isotropic("b", 3., 0.1, 1.3, 1.)},
                        [](const double f1, const double f2)
                        {
                          const int i = static_cast<int>(8. * f1), j = static_cast<int>(8. * f2);
                          return (i > 1 && i < 5 && j > 2 && j < 5) || (i == 4 && j > 4) ? 1 : 0;
                        });
}

double relative(const Eigen::Matrix<double, 10, 1> &found,
                const Eigen::Matrix<double, 10, 1> &expected)
{
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}
} // namespace

TEST(exact_second_order, a_homogeneous_cell_has_no_modes_and_the_cubic_energy_of_its_law)
{
  const Phase yarn{"yarn", 1e7, 1e6, 0.3, 4e5, 30., 5e-4, 400.};
  UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 7, 5, {yarn}, [](double, double) { return 0; });
  tests::shake(cell.mesh, cell.lattice, 3e-4);
  const Eigen::Matrix3d c = plane_stress_stiffness(yarn);
  for (const unsigned int order : {1u, 2u})
  {
    const Homogenization result = with_second_order(cell, order);
    for (const char *law : {"biot", "green"})
      EXPECT_EQ(result.second_order.at(law).chi.cwiseAbs().maxCoeff(), 0.) << law;
    EXPECT_LT(result.second_order.at("biot").energy.derivatives.cwiseAbs().maxCoeff(),
              1e-13 * c.maxCoeff());
    // Green's strain of the stretch I + E is E + E²/2: W3 = E.c.(E²/2).
    for (const Eigen::Vector3d &e :
         {Eigen::Vector3d(0.3, -0.2, 0.7), Eigen::Vector3d(-0.9, 0.4, 0.1)})
    {
      Eigen::Matrix2d E;
      E << e(0), 0.5 * e(2), 0.5 * e(2), e(1);
      const Eigen::Matrix2d half_square = 0.5 * E * E;
      const Eigen::Vector3d of_square(half_square(0, 0), half_square(1, 1), 2. * half_square(0, 1));
      const double expected = e.dot(c * of_square);
      EXPECT_NEAR(result.second_order.at("green").energy.value(e), expected, 1e-12 * c.maxCoeff());
    }
  }
}

TEST(derivative_cubic_form, gradient_and_hessian_are_the_derivatives_of_the_value)
{
  meshes::CubicForm form;
  form.derivatives << 1., -2., 0.5, 3., 0.7, -1.1, 2.2, 0.3, -0.6, 1.9;
  const Eigen::Vector3d E(0.3, -0.8, 0.5), d(0.2, 0.4, -0.7);
  // Differences of a cubic form that are exact.
  const double plus = form.value(E + d), minus = form.value(E - d);
  EXPECT_NEAR(form.gradient(E).dot(d), 0.5 * (plus - minus) - form.value(d), 1e-14);
  EXPECT_NEAR(d.dot(form.hessian(E) * d), plus + minus - 2. * form.value(E), 1e-14);
  for (std::size_t k = 0; k < form.indices.size(); ++k)
  {
    const auto [a, b, c] = form.indices[k];
    EXPECT_EQ(form.hessian(Eigen::Vector3d::Unit(c))(a, b),
              form.derivatives(static_cast<Eigen::Index>(k)));
  }
}

// chi and modes of stripes are piecewise linear: both elements hold them.
TEST(exact_second_order, stripes_have_the_same_second_order_with_p1_and_p2)
{
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(1.), 6, 4, tests::soft_and_hard(), tests::halves);
  const Homogenization linear = with_second_order(cell, 1), quadratic = with_second_order(cell, 2);
  for (const char *law : {"biot", "green"})
  {
    const meshes::SecondOrder &P1 = linear.second_order.at(law),
                              &P2 = quadratic.second_order.at(law);
    EXPECT_LT(relative(P1.energy.derivatives, P2.energy.derivatives), 1e-11);
    EXPECT_GT(P2.chi.cwiseAbs().maxCoeff(), 0.01);
    EXPECT_LT((P1.chi - P2.chi).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(invariant_second_order, the_cubic_energy_is_unchanged_when_the_cell_is_doubled)
{
  const UnitCell one = odd_cell();
  UnitCell four      = tests::cell_of({2. * one.lattice.vectors}, 16, 16, one.phases,
                                      [](double, double) { return 0; });
  for (int t = 0; t < four.mesh.n_triangles(); ++t)
    four.mesh.material(t) = one.mesh.material(2 * (t / 2 / 16 % 8 * 8 + t / 2 % 8) + t % 2);
  for (const unsigned int order : {1u, 2u})
  {
    const Homogenization of_one  = with_second_order(one, order),
                         of_four = with_second_order(four, order);
    for (const char *law : {"biot", "green"})
      EXPECT_LT(relative(of_four.second_order.at(law).energy.derivatives,
                         of_one.second_order.at(law).energy.derivatives),
                1e-9);
  }
}

// Turned by 90 degrees E11 and E22 change places and gamma12 changes its sign; mirrored, gamma12
// alone.
TEST(invariant_second_order, modes_and_cubic_energy_turn_and_are_mirrored_with_the_cell)
{
  const UnitCell cell = odd_cell();
  Eigen::Matrix2d quarter, mirror;
  quarter << 0., -1., 1., 0.;
  mirror << -1., 0., 0., 1.;
  for (const Eigen::Matrix2d &map : {quarter, mirror})
  {
    const bool is_turned = map == quarter;
    UnitCell mapped      = cell;
    mapped.mesh.vertices = cell.mesh.vertices * map.transpose();
    mapped.lattice.vectors << cell.lattice.vectors * map.transpose();
    for (Phase &phase : mapped.phases)
      phase.angle = is_turned ? phase.angle + 90. : -phase.angle;
    if (!is_turned)
    {
      mapped.mesh.triangles.col(1).swap(mapped.mesh.triangles.col(2));
      mapped.lattice.vectors.row(0) *= -1.;
    }
    const Homogenization before = with_second_order(cell), after = with_second_order(mapped);
    const auto place = [&](const int a) { return is_turned && a < 2 ? 1 - a : a; };
    for (const char *law : {"biot", "green"})
    {
      const meshes::SecondOrder &old = before.second_order.at(law),
                                &now = after.second_order.at(law);
      for (std::size_t k = 0; k < meshes::CubicForm::indices.size(); ++k)
      {
        const auto [a, b, c] = meshes::CubicForm::indices[k];
        const int n_shears   = (a == 2) + (b == 2) + (c == 2);
        EXPECT_NEAR(now.energy.hessian(Eigen::Vector3d::Unit(place(c)))(place(a), place(b)),
                    (n_shears % 2 ? -1. : 1.) *
                      old.energy.derivatives(static_cast<Eigen::Index>(k)),
                    1e-9 * old.energy.derivatives.cwiseAbs().maxCoeff())
          << law << " " << a << b << c;
      }
      const double size = old.chi.cwiseAbs().maxCoeff();
      for (std::size_t k = 0; k < meshes::strain_pairs.size(); ++k)
      {
        const auto [a, b]             = meshes::strain_pairs[k];
        const std::array<int, 2> pair = {std::min(place(a), place(b)),
                                         std::max(place(a), place(b))};
        const auto l = std::find(meshes::strain_pairs.begin(), meshes::strain_pairs.end(), pair) -
                       meshes::strain_pairs.begin();
        const double sign = (a == 2) != (b == 2) ? -1. : 1.;
        const meshes::Points of_old =
          sign * old.chi.middleCols<2>(2 * static_cast<Eigen::Index>(k)) * map.transpose();
        meshes::Points difference = now.chi.middleCols<2>(2 * l) - of_old;
        difference.rowwise() -= Eigen::RowVector2d(difference.row(0)); // the anchor may be another
        EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9 * size) << law << " " << a << b;
      }
    }
  }
}
