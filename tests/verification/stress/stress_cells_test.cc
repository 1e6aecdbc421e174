// SPDX-License-Identifier: MIT
// The cells of the stress cases, what is done to them, and that a wrong turn, a lost mirror or one
// triangle of the wrong phase is seen by the measure and the limit of these cases. What is written
// here beside them (the moved tensor, the direct solve) shares nothing with homogenize() but the
// mesh and the law of the phases.
#include "homogenization/bracket/compatible_strain.h"
#include "homogenization/cell/laminate.h"
#include "meshes/plain/errors.h"
#include "tests/refusal.h"
#include "tests/verification/stress/checks.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/energy_order.h"
#include "verification/stress/stress_axes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

using namespace homespun;
using namespace homespun::verification;
using tests::expect_no_promise_broken;
using tests::expect_refused;

namespace
{
/// A limit that no case of these cells exceeds, ten times over.
constexpr double limit = 1e-10;

constexpr int rows = 16;

Eigen::Matrix2d turn(const double angle)
{
  const double a = angle * M_PI / 180.;
  return (Eigen::Matrix2d() << std::cos(a), -std::sin(a), std::sin(a), std::cos(a)).finished();
}

const Eigen::Matrix2d mirror = Eigen::Vector2d(-1., 1.).asDiagonal();

Phase phase(const double modulus, const double nu = 0.3)
{
  return homogenization::isotropic("phase", modulus, nu, 5e-4, 400.);
}

/// 1e4 to 1.
Phase yarn(const double angle)
{
  return {"yarn", 1e9, 1e5, 0.3, 1e5, angle, 5e-4, 400.};
}

UnitCell stripes(const double contrast = 10., const double nu = 0.3)
{
  return stripe_cell(rows, phase(1e6, nu), phase(1e6 * contrast, nu));
}

UnitCell yarns()
{
  return inclusion_cell(rows, phase(1e6), yarn(20.));
}

UnitCell inclusion(const double contrast)
{
  return inclusion_cell(rows, phase(1e6), phase(1e6 * contrast));
}

Eigen::RowVector2d middle_of(const UnitCell &cell, const int t)
{
  return (cell.mesh.vertices.row(cell.mesh.triangles(t, 0)) +
          cell.mesh.vertices.row(cell.mesh.triangles(t, 1)) +
          cell.mesh.vertices.row(cell.mesh.triangles(t, 2))) /
         3.;
}

/// Two rectangles that touch neither each other nor their images.
UnitCell islands(const double contrast)
{
  UnitCell cell = inclusion(contrast);
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const Eigen::RowVector2d f = cell.lattice.fractional(middle_of(cell, t));
    cell.mesh.material(t)      = (std::abs(f(0) - 0.25) < 0.125 && std::abs(f(1) - 0.5) < 0.375) ||
                            (std::abs(f(0) - 0.75) < 0.125 && std::abs(f(1) - 0.625) < 0.125);
  }
  return cell;
}

/// The cell without the triangles of its second phase.
UnitCell with_holes(const UnitCell &cell)
{
  UnitCell rest = cell;
  std::map<int, int> place;
  int n = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (cell.mesh.material(t) == 0)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int v               = cell.mesh.triangles(t, k),
                  p               = place.emplace(v, static_cast<int>(place.size())).first->second;
        rest.mesh.triangles(n, k) = p;
        rest.mesh.vertices.row(p) = cell.mesh.vertices.row(v);
      }
      rest.mesh.material(n++) = 0;
    }
  rest.mesh.vertices.conservativeResize(static_cast<Eigen::Index>(place.size()), 2);
  rest.mesh.triangles.conservativeResize(n, 3);
  rest.mesh.material.conservativeResize(n);
  return rest;
}

UnitCell turned(const UnitCell &cell, const double angle)
{
  return mapped(cell, turn(angle));
}

UnitCell mirrored(const UnitCell &cell)
{
  return mapped(cell, mirror);
}

/// Another cut of the same cloth: each triangle is replaced by that image whose middle lies in the
/// parallelogram of the lattice at `origin` (parts of the lattice vectors). The outline follows the
/// edges of triangles and need not be straight.
UnitCell shifted(const UnitCell &cell, const Eigen::RowVector2d &origin)
{
  const meshes::ImageClasses classes = meshes::match_images(cell.mesh.vertices, cell.lattice);
  UnitCell other                     = cell;
  std::vector<Eigen::RowVector2d> points;
  std::map<std::array<int, 3>, int> vertex_of; // by class and the lattice point it is moved by
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    Eigen::RowVector2d middle = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      middle += cell.mesh.vertices.row(cell.mesh.triangles(t, k)) / 3.;
    const Eigen::RowVector2d f    = cell.lattice.fractional(middle) - origin;
    const Eigen::RowVector2i move = -f.array().floor().matrix().cast<int>();
    for (int k = 0; k < 3; ++k)
    {
      const int v                = cell.mesh.triangles(t, k),
                r                = classes.representative[static_cast<std::size_t>(v)];
      const Eigen::RowVector2i n = classes.offset.row(v) + move;
      const auto [place, is_new] =
        vertex_of.emplace(std::array<int, 3>{r, n(0), n(1)}, static_cast<int>(points.size()));
      if (is_new)
        points.emplace_back(cell.mesh.vertices.row(r) + n.cast<double>() * cell.lattice.vectors);
      other.mesh.triangles(t, k) = place->second;
    }
  }
  other.mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t v = 0; v < points.size(); ++v)
    other.mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
  return other;
}

/// The tensor C_ijkl = Q_ip Q_jq Q_kr Q_ls C_pqrs, index by index.
/// @param Q turns or mirrors @return Voigt order 11, 22, 12 with engineering shear
Eigen::Matrix3d moved_tensor(const Eigen::Matrix3d &C, const Eigen::Matrix2d &Q)
{
  const int voigt[2][2]  = {{0, 2}, {2, 1}};
  Eigen::Matrix3d moved  = Eigen::Matrix3d::Zero();
  const int row_of[3][2] = {{0, 0}, {1, 1}, {0, 1}};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          for (int r = 0; r < 2; ++r)
            for (int s = 0; s < 2; ++s)
              moved(a, b) += Q(row_of[a][0], p) * Q(row_of[a][1], q) * Q(row_of[b][0], r) *
                             Q(row_of[b][1], s) * C(voigt[p][q], voigt[r][s]);
  return moved;
}

Eigen::Matrix3d direct(const UnitCell &cell)
{
  const homogenization::TorusMesh torus = homogenization::glued(cell.mesh, cell.lattice);
  return homogenization::CompatibleStrain(torus, cell.stiffness_of_phase(), 1).stiffness;
}

/// What round-off may do to C^H.
double round_off(const UnitCell &cell)
{
  return algebraic_limit(cell, std::sqrt(0.5 * cell.mesh.n_triangles()));
}

/// C^H of the program beside another, by the energy of the worst macro strain, within round-off.
void expect_stiffness(const std::string &name, const UnitCell &cell,
                      const Eigen::Matrix3d &expected, const unsigned int order = 1)
{
  EXPECT_LE(energy_difference(solved(cell, order).stiffness, expected), round_off(cell))
    << name << ", P" << order;
}

Eigen::Matrix3d laminate(const UnitCell &cell)
{
  return homogenization::laminate_stiffness(cell.stiffness_of_phase(), {0.5, 0.5});
}
} // namespace

TEST(exact_stress_cells, the_direct_solve_of_stripes_is_the_laminate)
{
  EXPECT_LT(energy_difference(direct(stripes()), laminate(stripes())), 1e-12);
}

TEST(exact_stress_cells, the_measure_weighs_soft_directions_like_stiff_ones)
{
  const Eigen::Matrix3d B = Eigen::Vector3d(1e6, 1e-6, 1.).asDiagonal();
  Eigen::Matrix3d A       = B;
  A(1, 1) *= 1.5;
  EXPECT_NEAR(energy_difference(A, B), 0.5, 1e-12);
  EXPECT_NEAR(order_violation(A, B), 0.5, 1e-12);
  EXPECT_EQ(order_violation(B, A), 0.);
}

TEST(exact_stress_cells, spread_moduli_have_the_contrast_and_keep_the_softest)
{
  const UnitCell cell = with_contrast(stripes(), 1e4);
  EXPECT_DOUBLE_EQ(cell.phases[0].E1, stripes().phases[0].E1);
  EXPECT_NEAR(cell.phases[1].E1 / cell.phases[0].E1, 1e4, 1e-8);
  EXPECT_FALSE(has_contrast(stripes(1.)));
}

TEST(exact_stress_cells, laminates_are_met_by_p2_at_any_contrast_and_angle)
{
  for (const double contrast : {1e0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12})
    expect_stiffness("contrast", stripes(contrast), laminate(stripes(contrast)), 2);
  for (const double angle : {0., 15., 30., 45., 60., 75., 90.})
  {
    const UnitCell cell = stripe_cell(rows, phase(1e6), yarn(angle));
    for (const unsigned int order : {1u, 2u})
      expect_stiffness("angle " + std::to_string(angle), cell, laminate(cell), order);
  }
}

TEST(exact_stress_cells, the_smallest_cells_have_their_known_stiffness)
{
  UnitCell pair = stripe_cell(1, phase(1e6), phase(1e7));
  pair.mesh.material << 0, 1; // nothing can move: Voigt's mean
  const auto c = pair.stiffness_of_phase();
  // Twelve roundings of each entry, of which the softest direction keeps one part in 3.7.
  EXPECT_LT(energy_difference(solved(pair).stiffness, 0.5 * (c[0] + c[1])), 1e-14);
  const UnitCell eight = stripe_cell(2, phase(1e6), phase(1e7));
  expect_stiffness("eight triangles", eight, direct(eight));
}

TEST(invariant_stress_cells, yarns_of_1e4_to_1_turn_with_their_angle_and_their_cell)
{
  const Eigen::Matrix3d straight = stripe_cell(1, yarn(0.), yarn(0.)).stiffness_of_phase()[0],
                        before   = solved(yarns()).stiffness;
  for (const double angle : {0., 15., 30., 45., 60., 75., 90.})
  {
    expect_stiffness("homogeneous", stripe_cell(rows, yarn(angle), yarn(angle)),
                     moved_tensor(straight, turn(angle)));
    expect_stiffness("turned as a whole", turned(yarns(), angle),
                     moved_tensor(before, turn(angle)));
  }
}

TEST(invariant_stress_cells, moved_cells_are_sound_and_have_the_moved_stiffness)
{
  const Eigen::Matrix3d C                                     = direct(yarns());
  const std::vector<std::pair<UnitCell, Eigen::Matrix3d>> all = {
    {turned(yarns(), 30.), moved_tensor(C, turn(30.))},
    {mirrored(yarns()), moved_tensor(C, mirror)},
    {shifted(yarns(), {0.5, 0.}), C},
    {shifted(yarns(), {0.25, 0.5}), C},
    {shifted(yarns(), {0.3125, 0.6875}), C},
    {shifted(turned(mirrored(yarns()), 30.), {0.4375, 0.3125}),
     moved_tensor(C, turn(30.) * mirror)},
    {repeated(yarns(), 2, 1), C},
    {in_units(yarns(), {1e3, 1e3, 1e-9}), 1e-6 * C}};
  for (const auto &[cell, expected] : all)
  {
    EXPECT_LT(energy_difference(direct(cell), expected), limit);
    expect_stiffness("moved", cell, expected);
  }
}

TEST(tripwire_stress_cells, a_wrong_turn_is_noticed)
{
  const Eigen::Matrix3d C = direct(yarns()), found = direct(turned(yarns(), 30.));
  EXPECT_GT(energy_difference(found, moved_tensor(C, turn(-30.))), 1e3 * limit);
  EXPECT_GT(energy_difference(found, moved_tensor(C, turn(30.0001))), 1e3 * limit);
  EXPECT_GT(energy_difference(found, C), 1e3 * limit);
}

TEST(tripwire_stress_cells, a_phase_that_does_not_turn_with_its_mesh_is_noticed)
{
  UnitCell cell        = turned(yarns(), 30.);
  cell.phases[1].angle = yarns().phases[1].angle;
  EXPECT_GT(energy_difference(direct(cell), moved_tensor(direct(yarns()), turn(30.))), 1e3 * limit);
}

TEST(tripwire_stress_cells, a_mirrored_cell_that_keeps_the_angle_of_its_yarns_is_noticed)
{
  UnitCell cell        = mirrored(yarns());
  cell.phases[1].angle = yarns().phases[1].angle;
  EXPECT_GT(energy_difference(direct(cell), moved_tensor(direct(yarns()), mirror)), 1e3 * limit);
}

TEST(tripwire_stress_cells, one_triangle_of_the_wrong_phase_is_noticed)
{
  UnitCell cell          = repeated(stripes(), 2, 2);
  cell.mesh.material(17) = 1 - cell.mesh.material(17);
  EXPECT_GT(energy_difference(direct(cell), direct(stripes())), 1e3 * limit);
}

TEST(tripwire_stress_cells, unsound_cells_are_refused_by_name)
{
  UnitCell cell = stripes();
  cell.mesh.vertices.col(0) *= -1.;
  cell.lattice.vectors.col(0) *= -1.;
  expect_refused("triangles left clockwise", "inverted", [&]() { refuse_unsound(cell); });
  for (const double modulus : {0., -1e6})
    expect_refused("modulus", modulus == 0. ? "Young's modulus 0" : "Young's modulus -1e+06",
                   [&]() { refuse_unsound(inclusion(1e-6 * modulus)); });
  for (const char *const nu : {"-1", "1", "1.5"})
    expect_refused("nu", std::string("Poisson's ratio ") + nu,
                   [&]() { refuse_unsound(stripes(10., std::stod(nu))); });
  expect_refused("obtuse triangle of 1e-11", "has area",
                 [&]() { refuse_unsound(with_sliver(stripes(), 1e-11)); });
  expect_refused("row of needles of 1e-11", "has area",
                 [&]() { refuse_unsound(stripe_cell(rows, phase(1e6), phase(1e7), 1e-11)); });
  // 6e-8 of the side where they meet the outline, less than the tolerance of images.
  expect_refused("row of needles of 1e-6", "count as one",
                 [&]() { refuse_unsound(stripe_cell(rows, phase(1e6), phase(1e7), 1e-6)); });
  cell = stripes();
  cell.mesh.vertices(rows, 1) += 1e-3 * cell.lattice.vectors(1, 1);
  expect_refused("a corner off its image", "no periodic image", [&]() { refuse_unsound(cell); });
  cell = with_holes(inclusion(1.));
  expect_refused("a cut through a hole", "no periodic image",
                 [&]() {
                   refuse_unsound(shifted(cell, {0.5, 0.}));
                 });
}

TEST(bound_stress_cells, poissons_ratio_of_almost_one_half_and_minus_one_is_regular)
{
  for (const double nu : {-0.99, -0.9, -0.5, 0., 0.3, 0.49, 0.4999, 0.499999, 0.5})
  {
    Eigen::Matrix3d exact;
    exact << 1., nu, 0., nu, 1., 0., 0., 0., 0.5 * (1. - nu);
    expect_stiffness("homogeneous", stripes(1., nu), 1e6 * 5e-4 / (1. - nu * nu) * exact);
  }
}

TEST(bound_stress_cells, what_vanishes_does_so_with_the_slope_that_larger_ones_have)
{
  // Energies are linear in the modulus of a void as it vanishes, and in the compliance of an
  // inclusion as that vanishes. What is left beside the slope that larger ones have is of second
  // order, and round-off.
  const auto difference = [](UnitCell (*const of)(double), const double a, const double b)
  { return energy_difference(solved(of(a)).stiffness, solved(of(b)).stiffness); };
  const double of_void = difference(inclusion, 1e-5, 1e-6) / (1e-5 - 1e-6);
  EXPECT_LE(std::abs(energy_difference(solved(inclusion(1e-9)).stiffness,
                                       solved(with_holes(inclusion(1e-9))).stiffness) -
                     of_void * 1e-9),
            round_off(inclusion(1e-9)));
  for (UnitCell (*const of)(double) : {inclusion, islands})
  {
    const double slope = difference(of, 1e5, 1e6) / (1e-5 - 1e-6);
    EXPECT_LE(std::abs(difference(of, 1e9, 1e12) - slope * (1e-9 - 1e-12)), round_off(of(1e12)));
    expect_stiffness("two islands", islands(1e6), direct(islands(1e6)));
  }
}

TEST(bound_stress_cells, cells_that_are_slivers_and_needles_across_do_not_change_a_laminate)
{
  for (const double aspect : {1e-2, 1e-4})
  {
    UnitCell thin = stripes();
    thin.mesh.vertices.col(0) *= aspect;
    thin.lattice.vectors.col(0) *= aspect;
    expect_stiffness("a cell that is a sliver", thin, laminate(thin));
  }
  for (const double height : {1e-1, 1e-3, 1e-5})
  {
    // The row of needles turned across the stripes.
    UnitCell cell = turned(stripe_cell(rows, phase(1e6), phase(1e6), height), 90.);
    cell.phases   = stripes().phases;
    for (int t = 0; t < cell.mesh.n_triangles(); ++t)
      cell.mesh.material(t) = middle_of(cell, t)(1) > 0.5 * 0.01;
    expect_stiffness("needles across", cell, laminate(stripes()));
  }
}

TEST(bound_stress_cells, axes_keep_ten_digits_up_to_1e4_and_no_promise_is_broken)
{
  for (const StressAxis &axis : cell_axes(stripes(), 10000))
    for (const double value : axis.ladder)
      if (value <= 1e4)
      {
        EXPECT_LE(axis.at(value).error, limit) << axis.axis << " " << value;
      }
  expect_no_promise_broken(cell_axes(yarns(), 10000));
}
