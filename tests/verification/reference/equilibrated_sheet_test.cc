// SPDX-License-Identifier: MIT
// The elastic energy of a sheet in linear theory between its two sides: displacements above,
// self-equilibrated stresses below.
#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/refine.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/reference/displacement_energy.h"
#include "verification/reference/equilibrated_sheet.h"
#include "verification/reference/fine_reference.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;

namespace
{
constexpr double strain                   = 0.01;
const std::vector<const char *> the_loads = {"strip-1", "strip-2", "shear-frame"};

std::vector<homogenization::Phase> without_poisson()
{
  return {homogenization::isotropic("soft", 3., 0., 1., 1.),
          homogenization::isotropic("hard", 40., 0., 1., 1.)};
}

ReferenceStep solved(const meshes::Sheet &sheet, const std::vector<Eigen::Matrix3d> &stiffness,
                     const Load &load, const unsigned int order = 1)
{
  ReferenceOptions options;
  options.order = order;
  FineReference reference(sheet, stiffness, options, MPI_COMM_SELF);
  reference.start(load, Law::linear);
  const ReferenceStep step = reference.advance(strain);
  EXPECT_TRUE(step.reached) << step.why;
  return step;
}

/// Both sides, and the exact energy, agree to what round-off does to them.
void expect_known(const meshes::Sheet &sheet, const std::vector<Eigen::Matrix3d> &stiffness,
                  const Load &load, const meshes::Points &exact_positions, const double exact)
{
  const DisplacementEnergy upper =
    displacement_energy(sheet, stiffness, load, strain, exact_positions);
  const EquilibratedSheet lower(sheet, stiffness, load, strain);
  EXPECT_LT(upper.round_off, 1e-9 * exact);
  EXPECT_LT(lower.round_off, 1e-7 * exact);
  EXPECT_NEAR(upper.energy, exact, upper.round_off + 1e-14 * exact);
  EXPECT_NEAR(lower.energy, exact, lower.round_off + 1e-14 * exact);
  EXPECT_NEAR(upper.affine_work, upper.energy, upper.round_off_of_work);
  // Of first order in what conjugate gradients leave, 1e-18 of the energy; the energy is of second.
  EXPECT_NEAR(0.5 * lower.work, lower.energy, 1e-9 * lower.energy);
}

/// The same sheet with each triangle cut into four.
meshes::Sheet finer(const meshes::Sheet &sheet, const int times)
{
  meshes::Sheet result = sheet;
  result.mesh          = meshes::refined(sheet.mesh, times);
  return result;
}

/// Upper side less lower side of P1 on a mesh that is refined.
std::vector<double> gaps(const meshes::Sheet &sheet, const UnitCell &cell, const Load &load,
                         const int levels)
{
  std::vector<double> result;
  for (int level = 0; level < levels; ++level)
  {
    const meshes::Sheet fine       = finer(sheet, level);
    const auto stiffness           = cell.stiffness_of_phase();
    const meshes::Points positions = solved(fine, stiffness, load).positions;
    result.push_back(displacement_energy(fine, stiffness, load, strain, positions).energy -
                     EquilibratedSheet(fine, stiffness, load, strain).energy);
  }
  return result;
}

/// The smallest exponent at a right angle between a clamped and a free edge of an isotropic sheet
/// in plane stress, sin^2(lambda alpha) = ((kappa + 1)^2 − 4 lambda^2 sin^2 alpha) / (4 kappa) with
/// kappa = (3 − nu) / (1 + nu). Source: M. L. Williams, J. Appl. Mech. 19 (1952).
double exponent_of_clamped_corner(const double poisson)
{
  const double kappa = (3. - poisson) / (1. + poisson), right_angle = std::acos(0.);
  const auto function = [&](const double lambda)
  {
    return std::pow(std::sin(lambda * right_angle), 2) -
           (std::pow(kappa + 1., 2) - 4. * lambda * lambda) / (4. * kappa);
  };
  double low = 0.3, high = 1.;
  while (high - low > 1e-12)
    (function(0.5 * (low + high)) < 0. ? low : high) = 0.5 * (low + high);
  return low;
}

/// The edges of a sheet with the triangles beside them: (triangle, side).
std::map<std::array<int, 2>, std::vector<std::array<int, 2>>>
triangles_of_edges(const meshes::Sheet &sheet)
{
  std::map<std::array<int, 2>, std::vector<std::array<int, 2>>> edges;
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = sheet.mesh.triangles(t, k), b = sheet.mesh.triangles(t, (k + 1) % 3);
      edges[{std::min(a, b), std::max(a, b)}].push_back({t, k});
    }
  return edges;
}

/// Traction times length on a side of a triangle, outwards, at a part of the way along it.
Eigen::RowVector2d traction(const EquilibratedSheet &stress, const meshes::Sheet &sheet,
                            const std::array<int, 2> &side, const double part)
{
  const auto [t, k]              = side;
  const Eigen::RowVector2d along = sheet.mesh.vertices.row(sheet.mesh.triangles(t, (k + 1) % 3)) -
                                   sheet.mesh.vertices.row(sheet.mesh.triangles(t, k));
  const Eigen::Vector3d s = stress.stress(t, k, {1. - part, part, 0.});
  return {s(0) * along(1) - s(2) * along(0), s(2) * along(1) - s(1) * along(0)};
}
} // namespace

TEST(exact_energies, a_sheet_without_transverse_contraction_has_a_known_energy_on_both_sides)
{
  const UnitCell cell       = tests::cell_of(tests::square_lattice(0.01), 3, 4, without_poisson(),
                                             tests::everywhere_the_same);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 3, 2);
  const auto stiffness      = cell.stiffness_of_phase();
  for (const char *name : {"strip-1", "strip-2"})
  {
    const Load load(name);
    meshes::Points positions = sheet.mesh.vertices;
    for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
      positions.row(v) +=
        load.displacement(sheet.fraction(sheet.mesh.vertices.row(v)), sheet.sides(), strain);
    const double area = sheet.sides().determinant();
    expect_known(sheet, stiffness, load, positions,
                 0.5 * stiffness[0](0, 0) * strain * strain * area);
  }
}

TEST(exact_energies, layers_across_the_load_have_a_known_energy_on_both_sides)
{
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 3, 4, without_poisson(), tests::halves);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 2, 3);
  const auto stiffness      = cell.stiffness_of_phase();
  const double soft = stiffness[0](1, 1), hard = stiffness[1](1, 1);
  const double mean        = 2. / (1. / soft + 1. / hard); // of layers in series
  meshes::Points positions = sheet.mesh.vertices;
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const double layers  = sheet.fraction(sheet.mesh.vertices.row(v))(1) * 3.,
                 whole   = std::floor(layers + 1e-9);
    const double in_soft = std::min(layers - whole, 0.5), in_hard = layers - whole - in_soft;
    positions(v, 1) += strain * 0.01 * (whole + mean * (in_soft / soft + in_hard / hard));
  }
  expect_known(sheet, stiffness, Load("strip-2"), positions,
               0.5 * mean * strain * strain * sheet.sides().determinant());
}

TEST(exact_energies, holes_leave_phi_three_unknowns_each)
{
  // A hole with an empty middle, cut out of a strip that is pulled: with a filling that is a
  // billionth as stiff the energy of the whole sheet is the same but for that part.
  const auto phases = [](const double filling)
  {
    return std::vector<homogenization::Phase>{
      homogenization::isotropic("sheet", 1., 0.3, 1., 1.),
      homogenization::isotropic("hole", filling, 0.3, 1., 1.)};
  };
  UnitCell filled =
    tests::cell_of(tests::square_lattice(0.01), 8, 8, phases(1e-7), tests::square_inclusion);
  const meshes::Sheet full = meshes::tile(filled.mesh, filled.lattice, 2, 2);
  UnitCell cut             = filled;
  int kept                 = 0;
  for (int t = 0; t < filled.mesh.n_triangles(); ++t)
    if (filled.mesh.material(t) == 0)
    {
      cut.mesh.triangles.row(kept) = filled.mesh.triangles.row(t);
      cut.mesh.material(kept++)    = 0;
    }
  cut.mesh.triangles.conservativeResize(kept, 3);
  cut.mesh.material.conservativeResize(kept);
  // Vertices inside of the hole go.
  std::vector<int> place(static_cast<std::size_t>(cut.mesh.n_vertices()), -1);
  int n                   = 0;
  meshes::Points vertices = cut.mesh.vertices;
  for (int t = 0; t < kept; ++t)
    for (int k = 0; k < 3; ++k)
    {
      int &to = place[static_cast<std::size_t>(cut.mesh.triangles(t, k))];
      if (to < 0)
      {
        vertices.row(n) = cut.mesh.vertices.row(cut.mesh.triangles(t, k));
        to              = n++;
      }
      cut.mesh.triangles(t, k) = to;
    }
  cut.mesh.vertices             = vertices.topRows(n);
  const meshes::Sheet with_hole = meshes::tile(cut.mesh, cut.lattice, 2, 2);
  for (const char *name : the_loads)
  {
    const Load load(name);
    const EquilibratedSheet of_filled(full, filled.stiffness_of_phase(), load, strain),
      of_hole(with_hole, cut.stiffness_of_phase(), load, strain);
    // The filling adds energy, at most its own in the affine motion of the corners times contrast.
    EXPECT_GT(of_filled.energy, of_hole.energy) << name;
    EXPECT_NEAR(of_filled.energy, of_hole.energy, 1e-5 * of_hole.energy) << name;
  }
}

TEST(exact_energies, the_stress_is_in_equilibrium_and_does_the_work_of_its_tractions)
{
  UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 4, 4, tests::soft_and_hard(), tests::square_inclusion);
  tests::shake(cell.mesh, cell.lattice, 5e-4);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 2, 2);
  const auto stiffness      = cell.stiffness_of_phase();
  const auto edges          = triangles_of_edges(sheet);
  const double gauss[2]     = {0.5 - 0.5 / std::sqrt(3.), 0.5 + 0.5 / std::sqrt(3.)};
  for (const char *name : the_loads)
  {
    const Load load(name);
    const EquilibratedSheet stress(sheet, stiffness, load, strain);
    const double unit = std::sqrt(stress.energy * stiffness[0](0, 0)); // of a force
    double work       = 0.;
    Eigen::RowVector2d force(0., 0.);
    int n_free = 0;
    for (const auto &[ends, sides] : edges)
    {
      const Eigen::RowVector2d p = sheet.mesh.vertices.row(ends[0]),
                               q = sheet.mesh.vertices.row(ends[1]);
      const bool is_held =
        sides.size() == 1 && load.holds(sheet.fraction(p)) && load.holds(sheet.fraction(q));
      for (const double part : gauss)
      {
        Eigen::RowVector2d sum(0., 0.);
        for (const auto &side : sides)
        {
          const bool is_forward = sheet.mesh.triangles(side[0], side[1]) == ends[0];
          sum += traction(stress, sheet, side, is_forward ? part : 1. - part);
        }
        if (!is_held) // neighbours agree, free edges carry nothing
        {
          EXPECT_LT(sum.norm(), 1e-9 * unit) << name;
          n_free += sides.size() == 1;
          continue;
        }
        const Eigen::RowVector2d point = p + part * (q - p);
        work += 0.5 * sum.dot(load.displacement(sheet.fraction(point), sheet.sides(), strain));
        force += 0.5 * sum;
      }
    }
    EXPECT_EQ(n_free, 2 * 2 * 8) << name; // two free edges of 2 x 4 sides
    EXPECT_LT(force.norm(), 1e-9 * unit) << name;
    EXPECT_NEAR(stress.work, work, 1e-9 * stress.work) << name;
    EXPECT_GT(stress.work, 0.) << name;
  }
}

TEST(bound_energies, stresses_lie_below_and_displacements_above_for_every_cell)
{
  for (const char *name :
       {"auxetic", "checkerboard", "chevron", "hexagonal-dots", "honeycomb", "layered",
        "plain-weave", "printed-patch", "random-dots", "satin", "three-stiffness", "twill"})
  {
    const UnitCell cell       = homogenization::read_unit_cell(std::string(CELLS) + name + ".prm");
    const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
    const auto stiffness      = cell.stiffness_of_phase();
    for (const char *load_name : the_loads)
    {
      const Load load(load_name);
      const EquilibratedSheet lower(sheet, stiffness, load, strain);
      const ReferenceStep p1 = solved(sheet, stiffness, load),
                          p2 = solved(sheet, stiffness, load, 2);
      const DisplacementEnergy upper =
        displacement_energy(sheet, stiffness, load, strain, p1.positions);
      const double bar = upper.round_off + lower.round_off;
      EXPECT_LT(bar, 1e-5 * upper.energy) << name << " " << load_name;
      EXPECT_GT(upper.energy, lower.energy - bar) << name << " " << load_name;
      EXPECT_GT(p2.energy, lower.energy - bar) << name << " " << load_name;
      EXPECT_LT(p2.energy, upper.energy + bar) << name << " " << load_name;
      EXPECT_NEAR(p1.energy, upper.energy, upper.round_off) << name << " " << load_name;
      EXPECT_NEAR(upper.affine_work, upper.energy, upper.largest_misfit(p1.relative_residual))
        << name << " " << load_name;
    }
  }
}

TEST(order_energies, the_gap_closes_as_the_corners_of_clamped_and_free_edges_allow)
{
  // Both energies converge with the order 2 lambda of the corner, the displacement's with at most
  // 2 of P1: the order of the gap lies between.
  const UnitCell cell       = tests::cell_of(tests::square_lattice(0.01), 4, 4,
                                             {homogenization::isotropic("cloth", 1., 0.3, 1., 1.)},
                                             tests::everywhere_the_same);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 2, 2);
  const double slowest      = 2. * exponent_of_clamped_corner(0.3);
  EXPECT_NEAR(slowest, 1.517, 2e-3);
  for (const char *name : the_loads)
  {
    const std::vector<double> all = gaps(sheet, cell, Load(name), 4);
    const double order            = std::log2(all[2] / all[3]);
    EXPECT_GT(order, slowest - 0.1) << name;
    EXPECT_LT(order, 2. + 0.1) << name;
  }
}

TEST(order_energies, the_gap_of_a_cell_closes_when_its_mesh_is_halved)
{
  // Corners of phases have exponents of their own, all within (0, 1]: a factor of at most 4. Its
  // lower end stands for an exponent of 0.3, weaker corners than these have.
  const UnitCell cell = tests::cell_of(tests::square_lattice(0.01), 8, 8, tests::soft_and_hard(),
                                       tests::square_inclusion);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 2, 2);
  for (const char *name : the_loads)
  {
    const std::vector<double> all = gaps(sheet, cell, Load(name), 3);
    for (std::size_t level = 1; level < all.size(); ++level)
    {
      EXPECT_GT(all[level - 1] / all[level], 1.5) << name;
      EXPECT_LT(all[level - 1] / all[level], 4.) << name;
    }
  }
}

TEST(tripwire_energies, exchanged_phases_are_noticed_by_the_work_that_an_energy_must_equal)
{
  const UnitCell cell = tests::cell_of(tests::square_lattice(0.01), 8, 8, tests::soft_and_hard(),
                                       tests::square_inclusion);
  const meshes::Sheet sheet                = meshes::tile(cell.mesh, cell.lattice, 2, 2);
  const auto right                         = cell.stiffness_of_phase();
  const std::vector<Eigen::Matrix3d> wrong = {right[1], right[0]};
  for (const char *name : the_loads)
  {
    const Load load(name);
    const ReferenceStep step = solved(sheet, wrong, load);
    const DisplacementEnergy upper =
      displacement_energy(sheet, right, load, strain, step.positions);
    // Above the lower side it is, far above.
    EXPECT_GT(upper.energy, EquilibratedSheet(sheet, right, load, strain).energy) << name;
    EXPECT_GT(std::abs(upper.affine_work - upper.energy),
              1e3 * upper.largest_misfit(step.relative_residual))
      << name;
  }
}
