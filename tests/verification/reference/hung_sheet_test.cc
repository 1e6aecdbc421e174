// SPDX-License-Identifier: MIT
// The mass of a cloth by its lowest frequency: a sheet of two phases that differ in modulus,
// thickness and density, on a lattice that is neither square nor rectangular, hung at one edge.
// Known are the frequencies of vibrations.h, from E, nu, thickness and density.
#include "homogenization/cell/corners.h"
#include "shell/algebra/plane_matrix.h"
#include "shell/membrane/six_node_membrane.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/six_node_term.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/verification/reference/vibrations.h"
#include "verification/drape/draped_cell.h"
#include "verification/record/convergence.h"
#include "verification/reference/cloth_reference.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;
using tests::lowest;
using tests::Mass;
using tests::Pencil;
using tests::Vibration;

namespace
{
/// The lowest of the program's membrane and masses.
template <typename Membrane>
Vibration vibration_of(const Membrane &membrane, const Eigen::VectorXd &masses,
                       const std::vector<bool> &is_held)
{
  shell::PlaneMatrix matrix(membrane.triangles, is_held);
  shell::add_membrane_hessian(membrane, membrane.vertices, shell::Hessian::exact, matrix);
  EXPECT_TRUE(matrix.factorize());
  return tests::lowest([&](const meshes::Points &f) { return meshes::Points(matrix.solve(f)); },
                       [&](const meshes::Points &u)
                       { return meshes::Points(masses.asDiagonal() * u); },
                       meshes::Points::Ones(masses.size(), 2));
}

constexpr int n_cells = 2; ///< of the sheet, along each lattice vector

/// Constants of a phase: stripes along a1, the hard ones thin and light.
struct Constants
{
  double E, nu, thickness, density;

  Eigen::Matrix3d stiffness() const
  {
    Eigen::Matrix3d C;
    C << 1., nu, 0., nu, 1., 0., 0., 0., 0.5 * (1. - nu);
    return thickness * E / (1. - nu * nu) * C;
  }
};
const std::vector<Constants> soft_and_hard = {{1e6, 0.3, 8e-4, 1200.}, {6e6, 0.2, 3e-4, 500.}};

std::vector<Eigen::Matrix3d> stiffness_of_phase()
{
  return {soft_and_hard[0].stiffness(), soft_and_hard[1].stiffness()};
}

std::vector<double> density_of_phase()
{
  return {soft_and_hard[0].thickness * soft_and_hard[0].density,
          soft_and_hard[1].thickness * soft_and_hard[1].density};
}

/// Where the second lattice coordinate is smallest.
bool is_hung(const Eigen::RowVector2d &point)
{
  return std::abs(tests::skewed_lattice().fractional(point)(1)) < 1e-9;
}

std::vector<bool> hung(const meshes::Points &points)
{
  std::vector<bool> is_held;
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    is_held.push_back(is_hung(points.row(v)));
  return is_held;
}

/// The sheet as scenes have it, with n x n quads of the mesh in a cell.
DrapedCell draped(const int n)
{
  std::vector<homogenization::Phase> phases;
  for (const Constants &of : soft_and_hard)
    phases.push_back(homogenization::isotropic("", of.E, of.nu, of.thickness, of.density));
  const homogenization::UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), n, n, phases, tests::halves);
  Scene scene = read_scene(std::string(CELLS) + "../scenes/hang.prm");
  scene.n1 = scene.n2 = n_cells;
  return {scene, cell, tests::homogenized(cell), Law::biot};
}

Pencil pencil_of(const DrapedCell &cell, const int order)
{
  return tests::pencil_of(cell.fine.rest, order, stiffness_of_phase(), density_of_phase(), is_hung);
}

/// Order of a frequency: twice the smallest exponent of the corners of the sheet, which the order
/// of the mass, two, does not exceed.
double order_of_frequency(const std::vector<Eigen::Matrix3d> &stripes)
{
  const meshes::Lattice lattice = tests::skewed_lattice();
  const double right            = std::atan2(lattice.vectors(0, 1), lattice.vectors(0, 0)),
               up               = std::atan2(lattice.vectors(1, 1), lattice.vectors(1, 0));
  using homogenization::ClampedRay;
  std::vector<homogenization::Corner> corners = {
    {{{right, up, stripes.front()}}, false, ClampedRay::first},
    {{{up, right + M_PI, stripes.front()}}, false, ClampedRay::last}};
  if (stripes.size() == 2)
    for (const int below : {0, 1})
    {
      corners.push_back({{{up - M_PI, right, stripes[below]}, {right, up, stripes[1 - below]}},
                         false,
                         ClampedRay::none});
      corners.push_back(
        {{{up, right + M_PI, stripes[1 - below]}, {right + M_PI, up + M_PI, stripes[below]}},
         false,
         ClampedRay::none});
    }
  double order = 2.;
  for (const homogenization::Corner &corner : corners)
    order = std::min(order, 2. * homogenization::exponents_of(corner).front());
  return order;
}

/// Levels of lumped masses against P2 with consistent mass: by Richardson both have one limit, and
/// the distance from it falls with the order of theory.
void expect_one_limit(const std::vector<double> &sizes, const std::vector<double> &lumped,
                      const std::vector<double> &of_p2, const double order)
{
  const Richardson known = extrapolated(sizes, of_p2), limit = extrapolated(sizes, lumped, 0., 2.);
  ASSERT_TRUE(known.exists) << known.why;
  ASSERT_TRUE(limit.exists) << limit.why;
  EXPECT_LT(std::abs(limit.limit - known.limit), limit.gci + known.gci);
  EXPECT_LT(limit.gci + known.gci, 0.02 * known.limit);
  std::vector<double> errors;
  for (const double squared : lumped)
    errors.push_back(std::abs(squared / known.limit - 1.));
  const OrderJudgement judged = judge_errors(sizes, errors, {order - 0.1, 2.1});
  EXPECT_EQ(judged.outcome, Outcome::pass) << judged.why;
  std::printf("omega %.6f 1/s, P2 %.6f; errors", std::sqrt(limit.limit), std::sqrt(known.limit));
  for (std::size_t k = 0; k < errors.size(); ++k)
    std::printf(" %.2e (order %.2f)", errors[k], judged.observed[k]);
  std::printf("; theory %.3f to 2\n", order);
}

const std::vector<int> levels = {4, 8, 16, 32}; ///< quads per cell side
} // namespace

TEST(order_hung_sheet, its_lowest_frequency_by_lumped_masses_goes_to_that_of_consistent_mass)
{
  std::vector<double> sizes, lumped, of_p2;
  for (const int n : levels)
  {
    const DrapedCell cell = draped(n);
    sizes.push_back(1. / n);
    lumped.push_back(vibration_of(shell::membrane(cell.fine.rest, cell.phases.stiffness),
                                  shell::lumped_masses(cell.fine, cell.phases.areal_density),
                                  hung(cell.fine.rest.vertices))
                       .squared);
    of_p2.push_back(lowest(pencil_of(cell, 2), Mass::consistent).squared);
  }
  expect_one_limit(sizes, lumped, of_p2, order_of_frequency(stiffness_of_phase()));
}

// The coarse cloth of the same cell, of its effective stiffness and its mean mass.
TEST(order_hung_sheet, six_node_triangles_of_the_coarse_cloth_go_to_the_same)
{
  const DrapedCell cell         = draped(4);
  const Eigen::Matrix3d C       = cell.effective.stiffness.front();
  const double density          = cell.effective.areal_density.front();
  const std::vector<double> rho = density_of_phase();
  EXPECT_NEAR(density, 0.5 * (rho[0] + rho[1]), 1e-14);
  std::vector<double> sizes, three_nodes, six_nodes, of_p2;
  for (const int n : levels)
  {
    const int n_quads = n * n_cells;
    meshes::TriangleMesh mesh =
      meshes::coarse_sheet({0., 0.}, tests::skewed_lattice().vectors / n, n_quads, n_quads);
    mesh.material.setZero(mesh.n_triangles());
    const meshes::ClothMesh cloth = meshes::placed_sheet(
      mesh, Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
    const shell::SixNodeMesh six = shell::six_node_mesh(mesh, n_quads, n_quads);
    sizes.push_back(1. / n);
    three_nodes.push_back(vibration_of(shell::membrane(mesh, {C}),
                                       shell::lumped_masses(cloth, {density}), hung(mesh.vertices))
                            .squared);
    six_nodes.push_back(vibration_of(shell::six_node_membrane(six, C),
                                     shell::six_node_masses(six, density), hung(six.nodes))
                          .squared);
    of_p2.push_back(
      lowest(tests::pencil_of(mesh, 2, {C}, {density}, is_hung), Mass::consistent).squared);
  }
  expect_one_limit(sizes, three_nodes, of_p2, order_of_frequency({C}));
  expect_one_limit(sizes, six_nodes, of_p2, order_of_frequency({C}));
}

// Any weights that sum to one, alike at the corners and alike at the middles, have the right limit;
// those that keep the most of the consistent mass are its diagonal.
TEST(exact_hung_sheet, lumped_masses_are_the_scaled_diagonal_of_the_consistent_mass)
{
  const DrapedCell cell        = draped(4);
  const Eigen::VectorXd masses = shell::lumped_masses(cell.fine, cell.phases.areal_density);
  EXPECT_LT((masses - pencil_of(cell, 1).lumped).cwiseAbs().maxCoeff(), 1e-12 * masses.maxCoeff());

  constexpr int n           = 4;
  meshes::TriangleMesh grid = meshes::coarse_sheet({0., 0.}, tests::skewed_lattice().vectors, n, n);
  grid.material.setZero(grid.n_triangles());
  const shell::SixNodeMesh six = shell::six_node_mesh(grid, n, n);
  meshes::TriangleMesh corners = grid; // its triangles are twice as wide
  corners.triangles            = six.triangles.leftCols<3>();
  corners.material.setZero(corners.n_triangles());
  const Pencil own = tests::pencil_of(corners, 2, {Eigen::Matrix3d::Identity()}, {0.2}, is_hung);
  const Eigen::VectorXd of_six = shell::six_node_masses(six, 0.2);
  const int n_vertices         = grid.n_vertices();
  int n_found                  = 0;
  for (Eigen::Index node = 0; node < own.nodes.rows(); ++node)
    for (int v = 0; v < n_vertices; ++v)
      if (own.lumped(node) > 0. && (own.nodes.row(node) - grid.vertices.row(v)).norm() < 1e-12)
      {
        EXPECT_NEAR(of_six(v), own.lumped(node), 1e-12 * of_six.maxCoeff());
        ++n_found;
      }
  EXPECT_EQ(n_found, n_vertices);
}

// A step of implicit Euler from rest leaves the share 1 / (1 + omega^2 h^2) of a mode, if stiffness
// and mass are those of the mode. Of two steps from opposite sides the mean has no term of second
// order: 1e-6 is left of strains of 1e-3.
TEST(exact_hung_sheet, a_step_of_the_reference_shrinks_a_mode_as_its_frequency_says)
{
  const DrapedCell cell            = draped(4);
  const meshes::TriangleMesh &rest = cell.fine.rest;
  const auto lying = [](const Eigen::RowVector2d &X) { return Eigen::RowVector3d(X(0), X(1), 0.); };
  for (const int order : {1, 2})
    for (const Mass mass : {Mass::lumped, Mass::consistent})
    {
      const Pencil pencil    = pencil_of(cell, order);
      const Vibration known  = lowest(pencil, mass);
      const double amplitude = 1e-4 * std::sqrt(cell.cell.lattice.area());
      ClothReferenceOptions options;
      options.order           = static_cast<unsigned int>(order);
      options.consistent_mass = mass == Mass::consistent;
      options.tolerance       = 1e-7;
      const auto after_a_step = [&](const double size)
      {
        ClothReference reference(rest, cell.phases.stiffness, cell.phases.areal_density, options,
                                 MPI_COMM_SELF);
        reference.start(
          [&](const Eigen::RowVector2d &X)
          {
            Eigen::Index node = 0;
            (pencil.nodes.rowwise() - X).rowwise().squaredNorm().minCoeff(&node);
            return lying(X + size * known.mode.row(node));
          },
          [&](const Eigen::RowVector2d &X, double)
          { return is_hung(X) ? std::optional(lying(X)) : std::nullopt; },
          {});
        const ClothStep step = reference.step(1. / std::sqrt(known.squared));
        EXPECT_TRUE(step.reached) << step.why;
        EXPECT_EQ(step.n_parts, 1u);
        return meshes::Points(reference.positions().leftCols<2>());
      };
      const meshes::Points left =
        (after_a_step(amplitude) - after_a_step(-amplitude)) / (2. * amplitude);
      EXPECT_LT((left - 0.5 * known.mode.topRows(rest.n_vertices())).cwiseAbs().maxCoeff(), 1e-6)
        << order << (mass == Mass::lumped ? " lumped" : " consistent");
    }
}
