// SPDX-License-Identifier: MIT
// Forces of clamps and mean stresses, of the resolved sheet and of the coarse cloth.
#include "tests/homogenization/cell/cells.h"
#include "tests/verification/method/models.h"
#include "verification/reference/fine_reference.h"
#include "verification/reference/load_forces.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;

namespace
{
constexpr double side = 0.01; // of a cell [m]

UnitCell inclusion(const meshes::Lattice &lattice)
{
  return tests::cell_of(lattice, 4, 4, tests::soft_and_hard(), tests::square_inclusion);
}

UnitCell homogeneous(const double nu)
{
  return tests::cell_of(tests::square_lattice(side), 1, 1,
                        {homogenization::isotropic("cloth", 1e3, nu, 1., 1.)},
                        [](double, double) { return 0; });
}

ReferenceOptions of_order(const unsigned int order, const unsigned int refine = 0)
{
  ReferenceOptions options;
  options.order     = order;
  options.refine    = refine;
  options.tolerance = 1e-11;
  return options;
}

ReferenceStep solved_at(FineReference &reference, const double strain)
{
  const ReferenceStep step = reference.advance(strain);
  EXPECT_TRUE(step.reached) << step.why;
  return step;
}

/// dE/d(strain) by central differences of an energy.
double slope(const std::function<double(double)> &energy, const double strain)
{
  const double step = 1e-3 * strain;
  return (energy(strain + step) - energy(strain - step)) / (2. * step);
}

/// What the force along the load must be for that: per length of the clamp's way, or per area.
double force_of_slope(const double slope, const Load &load, const meshes::Sheet &sheet)
{
  return load.is_periodic() ? slope / std::abs(sheet.sides().determinant())
                            : slope / load.displacement({1., 1.}, sheet.sides(), 1.).norm();
}

double force_of(const Load &load, const meshes::Sheet &sheet, const LoadForces &forces)
{
  return load.is_periodic() ? force_per_width(load, sheet.sides(), forces)
                            : force_along(load, sheet.sides(), forces);
}
} // namespace

// The remainder of the central difference over 1e-3 of the strain is some 1e-7 of the force.
TEST(derivative_load_forces, of_the_resolved_cloth_are_those_of_its_energy)
{
  for (const bool is_skewed : {false, true})
  {
    const UnitCell cell =
      inclusion(is_skewed ? tests::skewed_lattice() : tests::square_lattice(side));
    for (const std::string &name : Load::names())
      for (const unsigned int order : {1u, 2u})
      {
        const Load load(name);
        const int n               = load.is_periodic() ? 1 : 2;
        const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
        FineReference reference(sheet, cell.stiffness_of_phase(), of_order(order), MPI_COMM_SELF);
        for (const Law law : {Law::linear, Law::biot, Law::green})
        {
          reference.start(load, law);
          const double force  = force_of(load, sheet, solved_at(reference, 0.05).forces);
          const double energy = force_of_slope(
            slope([&](const double strain) { return solved_at(reference, strain).energy; }, 0.05),
            load, sheet);
          EXPECT_NEAR(force / energy, 1., 1e-6) << name << order << name_of(law) << is_skewed;
          EXPECT_GT(force, 0.) << name << order << name_of(law) << is_skewed;
        }
      }
  }
}

TEST(derivative_load_forces, of_the_coarse_cloth_are_those_of_its_energy)
{
  for (const bool is_skewed : {false, true})
  {
    const UnitCell cell =
      inclusion(is_skewed ? tests::skewed_lattice() : tests::square_lattice(side));
    const meshes::HomogenizedCell as_one = tests::homogenized(cell);
    for (const std::string &name : Load::names())
    {
      const Load load(name);
      const int n               = load.is_periodic() ? 1 : 4;
      const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
      for (const Law law : {Law::linear, Law::biot})
      {
        const CoarseModel cloth({as_one}, sheet, load, Method("localized"), law);
        const shell::Membrane membrane = shell::membrane(cloth.mesh(), {as_one.stiffness});
        const CoarseState step         = cloth.solve(0.05);
        const auto energy_at           = [&](const double strain)
        {
          const shell::Positions<2> x = cloth.solve(strain, &step).positions;
          if (law == Law::biot)
            return shell::membrane_energy<2>(membrane, x);
          const shell::Positions<2> u = x - cloth.mesh().vertices;
          return 0.5 * u.cwiseProduct(shell::linear_membrane_gradient(membrane, u)).sum();
        };
        const double energy = force_of_slope(slope(energy_at, 0.05), load, sheet);
        EXPECT_NEAR(force_of(load, sheet, cloth.forces(step)) / energy, 1., 1e-6)
          << name << name_of(law) << is_skewed;
      }
    }
  }
}

// Without Poisson's ratio a clamped strip is uniform: P = E t strain along it, nothing across.
TEST(exact_load_forces, of_a_uniform_strip_are_those_of_the_closed_form_coarse_and_resolved)
{
  const UnitCell cell                  = homogeneous(0.);
  const meshes::Sheet sheet            = meshes::tile(cell.mesh, cell.lattice, 4, 3);
  const meshes::HomogenizedCell as_one = tests::homogenized(cell);
  for (const char *name : {"strip-1", "strip-2"})
    for (const Law law : {Law::linear, Law::biot})
    {
      const Load load(name);
      FineReference reference(sheet, cell.stiffness_of_phase(), of_order(1), MPI_COMM_SELF);
      reference.start(load, law);
      const double width = load.name == "strip-1" ? 3. * side : 4. * side;
      for (const LoadForces &forces :
           {solved_at(reference, 0.1).forces, tests::coarse_forces(as_one, sheet, load, law, 0.1)})
      {
        EXPECT_NEAR(force_along(load, sheet.sides(), forces) / (1e3 * 0.1 * width), 1., 1e-9);
        EXPECT_NEAR(force_per_width(load, sheet.sides(), forces) / 100., 1., 1e-9);
        const int along = load.axis();
        EXPECT_NEAR(forces.stress(along, along) / 100., 1., 1e-9);
        EXPECT_LT(std::abs(forces.stress(1 - along, 1 - along)), 1e-7);
      }
    }
}

TEST(exact_load_forces, of_a_homogeneous_infinite_cloth_are_those_of_hookes_law)
{
  const UnitCell cell                  = homogeneous(0.3);
  const meshes::Sheet sheet            = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const meshes::HomogenizedCell as_one = tests::homogenized(cell);
  const Eigen::Matrix3d C              = cell.stiffness_of_phase().front();
  for (int a = 0; a < 3; ++a)
  {
    const Load load(Load::names()[static_cast<std::size_t>(a)]);
    FineReference reference(sheet, cell.stiffness_of_phase(), of_order(1), MPI_COMM_SELF);
    reference.start(load, Law::linear);
    for (const LoadForces &forces : {solved_at(reference, 0.1).forces,
                                     tests::coarse_forces(as_one, sheet, load, Law::linear, 0.1)})
    {
      const Eigen::Vector3d expected = 0.1 * C.col(a);
      EXPECT_NEAR(forces.stress(0, 0), expected(0), 1e-10 * C(0, 0));
      EXPECT_NEAR(forces.stress(1, 1), expected(1), 1e-10 * C(0, 0));
      EXPECT_NEAR(forces.stress(0, 1), expected(2), 1e-10 * C(0, 0));
      EXPECT_NEAR(forces.stress(1, 0), expected(2), 1e-10 * C(0, 0));
      EXPECT_NEAR(force_per_width(load, sheet.sides(), forces), expected(a), 1e-10 * C(0, 0));
      EXPECT_EQ(forces.on_clamps, Eigen::Matrix2d::Zero());
      EXPECT_TRUE(std::isnan(force_along(load, sheet.sides(), forces)));
    }
  }
}

// Homogenization is exact for an infinite cloth in linear theory: the mean stress is C^H : E.
TEST(exact_load_forces, of_an_infinite_cloth_are_equal_coarse_and_resolved_in_linear_theory)
{
  const UnitCell cell       = inclusion(tests::skewed_lattice());
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const auto as_one         = tests::homogenized(cell);
  for (const char *name : {"periodic-11", "periodic-22", "periodic-12"})
  {
    const Load load(name);
    FineReference reference(sheet, cell.stiffness_of_phase(), of_order(1), MPI_COMM_SELF);
    reference.start(load, Law::linear);
    const Eigen::Matrix2d resolved = solved_at(reference, 0.02).forces.stress,
                          coarse =
                            tests::coarse_forces(as_one, sheet, load, Law::linear, 0.02).stress;
    EXPECT_LT((resolved - coarse).cwiseAbs().maxCoeff(), 1e-9 * resolved.cwiseAbs().maxCoeff());
  }
}

// Triangles pull on themselves alone: what the clamps exert adds up to what the free vertices lack.
TEST(invariant_load_forces, both_clamps_balance_and_carry_the_mean_stress)
{
  const UnitCell cell       = inclusion(tests::square_lattice(side));
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 3, 2);
  const auto as_one         = tests::homogenized(cell);
  for (const char *name : {"strip-1", "strip-2", "shear-frame"})
    for (const Law law : {Law::linear, Law::biot})
      for (const unsigned int order : {0u, 1u, 2u}) // 0: the coarse cloth
      {
        const Load load(name);
        LoadForces forces;
        if (order == 0)
          forces = tests::coarse_forces(as_one, sheet, load, law, 0.1);
        else
        {
          FineReference reference(sheet, cell.stiffness_of_phase(), of_order(order), MPI_COMM_SELF);
          reference.start(load, law);
          forces = solved_at(reference, 0.1).forces;
        }
        const double size = forces.on_clamps.row(1).norm();
        EXPECT_LT(forces.on_clamps.colwise().sum().norm(), 1e-8 * size) << name << order;
        // A cut along the moving clamp has its force; the other sides are free.
        const int along    = load.axis();
        const double width = sheet.sides().row(1 - along).norm();
        EXPECT_LT((forces.stress.col(along).transpose() * width - forces.on_clamps.row(1)).norm(),
                  1e-8 * size)
          << name << order;
      }
}

// The same from the positions alone, by another code.
TEST(exact_load_forces, sheet_energy_is_that_of_the_reference_at_its_positions)
{
  const UnitCell cell = inclusion(tests::skewed_lattice());
  for (const std::string &name : Load::names())
    for (const Law law : {Law::linear, Law::biot, Law::green})
    {
      const Load load(name);
      const int n               = load.is_periodic() ? 1 : 2;
      const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
      FineReference reference(sheet, cell.stiffness_of_phase(), of_order(1), MPI_COMM_SELF);
      reference.start(load, law);
      const ReferenceStep step = solved_at(reference, 0.05);
      const SheetEnergy of_them =
        sheet_energy(sheet, cell.stiffness_of_phase(), law, step.positions);
      EXPECT_NEAR(of_them.energy / step.energy, 1., 1e-11) << name;
      EXPECT_LT((of_them.stress - step.forces.stress).norm(), 1e-11 * step.forces.stress.norm())
        << name;
    }
}

// The minimum over more displacements is lower, and in linear theory the force is twice the energy
// over the way of the clamp.
TEST(bound_load_forces, in_linear_theory_fall_from_affine_motion_to_refined_elements)
{
  const UnitCell cell       = inclusion(tests::square_lattice(side));
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 2, 2);
  const auto as_one         = tests::homogenized(cell);
  for (const char *name : {"strip-1", "strip-2", "shear-frame"})
  {
    const Load load(name);
    const meshes::Points interpolated =
      tests::upsampled("affine", {as_one}, sheet, load, Law::linear, 0.01);
    const double way = load.displacement({1., 1.}, sheet.sides(), 0.01).norm();
    double before =
      2. * sheet_energy(sheet, cell.stiffness_of_phase(), Law::linear, interpolated).energy / way;
    for (const ReferenceOptions &options : {of_order(1), of_order(2), of_order(2, 1)})
    {
      FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
      reference.start(load, Law::linear);
      const ReferenceStep step = solved_at(reference, 0.01);
      const double force       = force_along(load, sheet.sides(), step.forces);
      EXPECT_NEAR(force / (2. * step.energy / way), 1., 1e-9) << name;
      EXPECT_LT(force, before * (1. - 1e-6)) << name << options.order << options.refine;
      before = force;
    }
  }
}

TEST(ranks_load_forces, are_the_same_on_one_rank_and_on_all)
{
  const UnitCell cell       = inclusion(tests::square_lattice(side));
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 3, 3);
  for (const unsigned int order : {1u, 2u})
  {
    const Load load("shear-frame");
    FineReference alone(sheet, cell.stiffness_of_phase(), of_order(order), MPI_COMM_SELF);
    FineReference shared(sheet, cell.stiffness_of_phase(), of_order(order), MPI_COMM_WORLD);
    alone.start(load, Law::biot);
    shared.start(load, Law::biot);
    const LoadForces a = solved_at(alone, 0.05).forces, b = solved_at(shared, 0.05).forces;
    EXPECT_LT((a.on_clamps - b.on_clamps).norm(), 1e-8 * a.on_clamps.norm());
    EXPECT_LT((a.stress - b.stress).norm(), 1e-8 * a.stress.norm());
  }
}
