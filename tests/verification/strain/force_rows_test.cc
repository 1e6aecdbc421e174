// SPDX-License-Identifier: MIT
// The rows of forces.csv: resolved, coarse and affine at one level.
#include "tests/homogenization/cell/cells.h"
#include "verification/strain/force_rows.h"
#include "verification/strain/strain_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double strain = 0.1, bar = 0.02;

std::vector<ForceRow> rows_of(const homogenization::UnitCell &cell, const std::string &name,
                              const Law law)
{
  const Load load(name);
  const int n               = load.is_periodic() ? 1 : 3;
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
  const meshes::HomogenizedCell as_one =
    homogenization::homogenized_cell(cell, tests::solved(cell), "test");
  ReferenceOptions options;
  options.tolerance = 1e-11;
  FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
  reference.start(load, law);
  const ReferenceStep fine = reference.advance(strain);
  EXPECT_TRUE(fine.reached) << fine.why;
  MethodsOnSheet methods   = methods_on_sheet(cell, as_one, {}, sheet, load);
  const CoarseModel &model = methods.at(law, "localized").model;
  return force_rows({cell.name, name, law, strain},
                    {sheet, fine, 0, 1, {0., 0., 0., bar}, Stability::every_triangle, 0.}, methods,
                    model, model.solve(strain));
}
} // namespace

// On one mesh the three cloths are one. A central difference over a thousandth lacks some 1e-6.
TEST(exact_force_rows, of_a_homogeneous_cell_of_two_triangles_are_all_the_same)
{
  const homogenization::UnitCell cell = tests::cell_of(
    tests::square_lattice(0.01), 1, 1, {homogenization::isotropic("cloth", 1e3, 0.3, 1., 1.)},
    [](double, double) { return 0; });
  for (const std::string &name : Load::names())
    for (const Law law : {Law::linear, Law::biot})
    {
      const std::vector<ForceRow> rows = rows_of(cell, name, law);
      ASSERT_EQ(rows.size(), 3u);
      EXPECT_EQ(rows[0].method + rows[1].method + rows[2].method, "resolvedcoarseaffine");
      EXPECT_EQ(std::isnan(rows[0].force), Load(name).is_periodic());
      EXPECT_EQ(std::isnan(rows[0].travel), Load(name).is_periodic());
      for (const ForceRow &row : rows)
      {
        EXPECT_NEAR(row.per_width / rows[0].per_width, 1., 1e-5) << name << row.method;
        if (!Load(name).is_periodic())
        {
          EXPECT_NEAR(row.travel, strain * 0.03, 1e-14) << name << row.method;
        }
        EXPECT_DOUBLE_EQ(row.bar, bar * std::abs(rows[0].per_width));
        EXPECT_NEAR(row.stress_22, rows[0].stress_22, 1e-7 * 100.) << name << row.method;
        EXPECT_NEAR(row.stress_12, rows[0].stress_12, 1e-7 * 100.) << name << row.method;
      }
    }
}

// No motion with the prescribed values has less energy than the solution; its force is twice its
// energy over the way of the clamp.
TEST(bound_force_rows, the_affine_motion_takes_more_than_the_resolved_sheet_in_linear_theory)
{
  const homogenization::UnitCell cell = tests::cell_of(
    tests::square_lattice(0.01), 4, 4, tests::soft_and_hard(), tests::square_inclusion);
  std::vector<std::string> names = Load::names();
  names.insert(names.end(), {"uniaxial-1", "uniaxial-2"});
  for (const std::string &name : names)
  {
    const std::vector<ForceRow> rows = rows_of(cell, name, Law::linear);
    EXPECT_GT(rows[2].per_width, rows[0].per_width * 1.01) << name;
  }
  // Phases that contract differently, side by side: the force along the pull alone would be too
  // small, because the motion squeezes them sideways too.
  const homogenization::UnitCell layers =
    tests::cell_of(tests::square_lattice(0.01), 4, 4,
                   {homogenization::isotropic("soft", 1e3, 0.49, 1., 1.),
                    homogenization::isotropic("hard", 5e3, 0.2, 1., 1.)},
                   [](const double x, double) { return x < 0.5 ? 0 : 1; });
  for (const std::string name : {"uniaxial-1", "uniaxial-2"})
  {
    const std::vector<ForceRow> rows = rows_of(layers, name, Law::linear);
    EXPECT_GT(rows[2].per_width, rows[0].per_width) << name;
  }
}
