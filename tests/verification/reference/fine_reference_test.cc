// SPDX-License-Identifier: MIT
#include "homogenization/fem/homogenize.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/verification/method/models.h"
#include "verification/record/convergence.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/claims/strain_verdicts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace homespun;
using namespace homespun::verification;
using homogenization::UnitCell;

namespace
{
std::vector<homogenization::Phase> one_phase()
{
  return {{"yarn", 1e3, 3e2, 0.3, 2e2, 25., 1., 1.}};
}
} // namespace

TEST(exact_fine_reference, a_homogeneous_sheet_moves_like_the_coarse_cloth_on_the_same_mesh)
{
  // Two codes that share nothing: deal.II with the law of verification, and the shell's element.
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 1, 1, one_phase(), tests::everywhere_the_same);
  const meshes::Sheet sheet               = meshes::tile(cell.mesh, cell.lattice, 8, 8);
  const meshes::HomogenizedCell as_itself = tests::homogenized(cell);
  for (const char *name : {"strip-1", "strip-2", "shear-frame"})
    for (const Law law : {Law::linear, Law::biot})
    {
      const Load load(name);
      FineReference reference(sheet, cell.stiffness_of_phase(), ReferenceOptions(), MPI_COMM_SELF);
      reference.start(load, law);
      const ReferenceStep fine = reference.advance(0.15);
      ASSERT_TRUE(fine.reached) << fine.why;
      const meshes::Points same = tests::upsampled("affine", {as_itself}, sheet, load, law, 0.15);
      EXPECT_LT((same - fine.positions).rowwise().norm().maxCoeff(), 1e-8 * 0.01)
        << name << " " << name_of(law);
    }
}

TEST(exact_fine_reference, stripes_stretched_along_their_axes_are_localized_without_error)
{
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 4, 6, tests::soft_and_hard(), tests::halves);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  for (const char *name : {"periodic-11", "periodic-22"})
    for (const unsigned int order : {1u, 2u})
    {
      const Load load(name);
      ReferenceOptions options;
      options.order = order;
      FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
      reference.start(load, Law::biot);
      const ReferenceStep fine        = reference.advance(0.2);
      const meshes::HomogenizedCell h = tests::homogenized(cell);
      const auto of                   = [&](const char *method)
      { return tests::upsampled(method, {h}, sheet, load, Law::biot, 0.2); };
      const meshes::Points upsampled = of("localized");
      EXPECT_LT((upsampled - fine.positions).cwiseAbs().maxCoeff(), 1e-12) << name << order;
      // And the check can fail: without chi, or with its sign turned, the error is large.
      const meshes::Points without = of("affine");
      if (load.name == "periodic-22")
      {
        EXPECT_GT((without - fine.positions).cwiseAbs().maxCoeff(), 1e-4);
      }
    }
}

TEST(order_fine_reference, the_localized_error_of_periodic_loads_falls_as_strain_squared)
{
  // A pattern in two directions, so that no load is linear by accident.
  const UnitCell cell = tests::cell_of(tests::square_lattice(0.01), 8, 8, tests::soft_and_hard(),
                                       tests::square_inclusion);
  const meshes::Sheet sheet       = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const meshes::HomogenizedCell h = tests::homogenized(cell);
  for (const char *name : {"periodic-11", "periodic-22", "periodic-12"})
  {
    const Load load(name);
    ReferenceOptions options;
    options.tolerance = 1e-10;
    FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
    reference.start(load, Law::biot);
    std::vector<double> strains, errors, wrong;
    for (const double strain : {1e-4, 1e-3, 1e-2, 1e-1})
    {
      const ReferenceStep fine = reference.advance(strain);
      ASSERT_TRUE(fine.reached) << fine.why;
      ASSERT_TRUE(fine.reached) << fine.why;
      const auto error = [&](const char *method)
      {
        return (tests::upsampled(method, {h}, sheet, load, Law::biot, strain) - fine.positions)
          .rowwise()
          .norm()
          .mean();
      };
      strains.push_back(strain);
      errors.push_back(error("localized"));
      wrong.push_back(error("affine"));
    }
    EXPECT_NEAR(log_slope(strains, errors), 2., 0.1) << name;
    EXPECT_NEAR(log_slope(strains, wrong), 1., 0.1) << name; // what a lost chi would show
  }
}

TEST(invariant_fine_reference, a_level_does_not_depend_on_the_levels_before_it)
{
  const UnitCell cell = tests::cell_of(tests::square_lattice(0.01), 6, 6, tests::soft_and_hard(),
                                       tests::square_inclusion);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 2, 2);
  FineReference reference(sheet, cell.stiffness_of_phase(), ReferenceOptions(), MPI_COMM_SELF);
  for (const Law law : {Law::biot, Law::green})
  {
    reference.start(Load("strip-2"), law);
    for (const double strain : {0.01, 0.05})
      reference.advance(strain);
    const meshes::Points walked = reference.advance(0.1).positions;
    reference.start(Load("strip-2"), law);
    const meshes::Points at_once = reference.advance(0.1).positions;
    EXPECT_LT((walked - at_once).cwiseAbs().maxCoeff(), 1e-8 * 0.01) << name_of(law);
  }
}

TEST(exact_fine_reference,
     a_weave_has_its_equilibrium_at_small_strain_though_round_off_hides_the_tolerance)
{
  // Yarns 1e4 times as stiff as their shear: at a strain of 1e-6 the forces of shear are 1e-10 of
  // those that rounded gradients make in the yarns.
  const std::vector<homogenization::Phase> yarns = {{"warp", 1e9, 1e6, 0.3, 1e5, 0., 5e-4, 400.},
                                                    {"weft", 1e9, 1e6, 0.3, 1e5, 90., 5e-4, 400.}};
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 8, 8, yarns,
                   [](const double x, const double y) { return (x < 0.5) == (y < 0.5) ? 0 : 1; });
  ReferenceOptions options;
  options.tolerance = 1e-11;
  for (const auto &[name, n] : {std::pair{"periodic-12", 1}, std::pair{"shear-frame", 4}})
  {
    const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
    FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
    const Load load(name);
    reference.start(load, Law::linear);
    const ReferenceStep linear = reference.advance(1e-6);
    reference.start(load, Law::biot);
    const ReferenceStep biot = reference.advance(1e-6);
    ASSERT_TRUE(linear.reached) << name << ": " << linear.why;
    ASSERT_TRUE(biot.reached) << name << ": " << biot.why;
    // Both laws agree in the limit: to the strain against what the shear bears, 1e-6 x 1e4, of the
    // motion.
    const double distance = (biot.positions - linear.positions).rowwise().norm().maxCoeff();
    EXPECT_LT(distance, 1e-2 * 1e-6 * 0.01 * n) << name;
  }
}

TEST(exact_fine_reference, held_edges_are_where_the_load_puts_them)
{
  const UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 4, 4, tests::soft_and_hard(), tests::halves);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 2, 3);
  for (const char *name : {"strip-1", "strip-2", "shear-frame"})
    for (const unsigned int order : {1u, 2u})
    {
      ReferenceOptions options;
      options.order = order;
      FineReference reference(sheet, cell.stiffness_of_phase(), options, MPI_COMM_SELF);
      const Load load(name);
      reference.start(load, Law::biot);
      const ReferenceStep step = reference.advance(0.1);
      ASSERT_TRUE(step.reached);
      int n_held = 0;
      for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
      {
        const Eigen::RowVector2d f =
          sheet.lattice.fractional(sheet.mesh.vertices.row(v) - sheet.origin);
        const int axis = load.name == "strip-1" ? 0 : 1, n = axis == 0 ? 2 : 3;
        Eigen::RowVector2d moved = Eigen::RowVector2d::Zero();
        if (f(axis) > n - 1e-9)
          moved = load.name == "shear-frame"
                    ? Eigen::RowVector2d(0.1 * (3. * sheet.lattice.vectors.row(1)).norm() *
                                         sheet.lattice.vectors.row(0).normalized())
                    : Eigen::RowVector2d(0.1 * n * sheet.lattice.vectors.row(axis));
        else if (f(axis) > 1e-9)
          continue;
        ++n_held;
        EXPECT_LT((step.positions.row(v) - sheet.mesh.vertices.row(v) - moved).norm(), 1e-15);
      }
      EXPECT_EQ(n_held, load.name == "strip-1" ? 26 : 18);
    }
}

TEST(tripwire_fine_reference, a_strain_without_equilibrium_is_reported_and_earlier_levels_stay)
{
  // St. Venant-Kirchhoff under this compression has no stable state.
  const UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 4, 4, tests::soft_and_hard(), tests::halves);
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 4, 4);
  FineReference reference(sheet, cell.stiffness_of_phase(), ReferenceOptions(), MPI_COMM_SELF);
  reference.start(Load("shear-frame"), Law::green);
  EXPECT_TRUE(reference.advance(0.02).reached);
  const ReferenceStep step = reference.advance(0.9);
  EXPECT_FALSE(step.reached);
  EXPECT_NE(step.why.find("stopped at strain"), std::string::npos);
  EXPECT_TRUE(reference.advance(0.03).reached);
}
