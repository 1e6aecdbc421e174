// SPDX-License-Identifier: MIT
// Faults planted into the bracket, by spoiling the glued mesh on which it is solved (pairs tied to
// the wrong partner), or through cells on which right code gives what wrong code would give
// (signs): each must be noticed by one of the checks of bracket_test.cc. The right mesh passes all
// of them.
#include "homogenization/bracket/bracket.h"
#include "tests/homogenization/bracket/bracket_cells.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <functional>

using namespace homespun;
using namespace homespun::homogenization;
using tests::of_bulk_and_shear;

namespace
{
using Fault = std::function<void(TorusMesh &)>;

constexpr double bulk[2] = {0.8, 30.}, shear[2] = {0.5, 2.};

tests::BracketCell fine_odd_cell(const std::vector<Eigen::Matrix3d> &stiffness)
{
  return tests::bracket_cell(tests::skewed_lattice(), 16, 16, stiffness, tests::odd_pattern);
}

TorusMesh spoilt(const tests::BracketCell &cell, const Fault &fault)
{
  TorusMesh mesh = glued(cell.mesh, cell.lattice);
  fault(mesh);
  return mesh;
}

/// By how much the shift of Cherkaev, Lurie and Milton misses in the compliance, relative.
double shift_fault(const Fault &fault)
{
  const double lambda   = 0.3;
  Eigen::Matrix3d shift = Eigen::Matrix3d::Zero();
  shift(0, 1) = shift(1, 0) = 0.5 * lambda;
  shift(2, 2)               = -lambda;
  const auto compliance     = [&](const double by) -> Eigen::Matrix3d
  {
    std::vector<Eigen::Matrix3d> stiffness;
    for (int p = 0; p < 2; ++p)
      stiffness.push_back(of_bulk_and_shear(1. / (1. / bulk[p] + by), 1. / (1. / shear[p] - by)));
    const tests::BracketCell cell = fine_odd_cell(stiffness);
    return bracket(spoilt(cell, fault), cell.stiffness, 2).compliance;
  };
  const Eigen::Matrix3d before = compliance(0.);
  return (compliance(lambda) - before - shift).cwiseAbs().maxCoeff() / before.cwiseAbs().maxCoeff();
}

/// By how much lower <= upper fails, relative to upper; negative where it holds.
double violation(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper)
{
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(lower - upper, upper)
    .eigenvalues()(2);
}

/// By how much Hill's exact stiffness of equal shear moduli lies outside of the bracket.
struct HillFault
{
  double below, above;
};
HillFault hill_fault(const Fault &fault)
{
  const double G = 1., K[2] = {1.5, 40.};
  const tests::BracketCell cell =
    fine_odd_cell({of_bulk_and_shear(K[0], G), of_bulk_and_shear(K[1], G)});
  double part = 0.;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    part += static_cast<double>(cell.mesh.material(t)) / cell.mesh.n_triangles();
  const Eigen::Matrix3d exact =
    of_bulk_and_shear(1. / ((1. - part) / (K[0] + G) + part / (K[1] + G)) - G, G);
  const Bracket b = bracket(spoilt(cell, fault), cell.stiffness, 2);
  return {violation(b.lower, exact), violation(exact, b.upper)};
}

/// Two edges with the same vector, seen by triangles on the same side, whose other ends are not
/// shared.
struct Twins
{
  std::size_t triangles[2];
  std::size_t place;
};
Twins twins_of(const TorusMesh &mesh)
{
  // The first triangle whose square is stiff, and one that is its image by some steps of the grid.
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.triangles[t].material == 1)
      for (std::size_t other = t + 8; other < mesh.triangles.size(); ++other)
        if (mesh.triangles[other].material == 0)
          for (std::size_t k = 0; k < 3; ++k)
          {
            const auto &a = mesh.triangles[t], &b = mesh.triangles[other];
            const Eigen::Vector2d va =
              a.signs[k] * mesh.edges[static_cast<std::size_t>(a.edges[k])].vector;
            const Eigen::Vector2d vb =
              b.signs[k] * mesh.edges[static_cast<std::size_t>(b.edges[k])].vector;
            if (a.signs[k] == b.signs[k] && (va - vb).norm() < 1e-9 * va.norm())
              return {{t, other}, k};
          }
  ADD_FAILURE() << "no two edges are alike";
  return {};
}

void nothing(TorusMesh &)
{
}

/// The unknowns on two edges are exchanged for the triangles on one side of them.
void tie_edges_to_the_wrong_partners(TorusMesh &mesh)
{
  const Twins twins = twins_of(mesh);
  std::swap(mesh.triangles[twins.triangles[0]].edges[twins.place],
            mesh.triangles[twins.triangles[1]].edges[twins.place]);
}

/// The same with vertices.
void tie_vertices_to_the_wrong_partners(TorusMesh &mesh)
{
  const Twins twins = twins_of(mesh);
  std::swap(mesh.triangles[twins.triangles[0]].vertices[twins.place],
            mesh.triangles[twins.triangles[1]].vertices[twins.place]);
}

/// A triangle that is assembled with the other phase.
void exchange_a_material(TorusMesh &mesh)
{
  const Twins twins                           = twins_of(mesh);
  mesh.triangles[twins.triangles[0]].material = 0;
}
} // namespace

TEST(tripwire_bracket, nothing_planted_is_noticed_by_no_check)
{
  EXPECT_LT(shift_fault(nothing), 1e-11);
  EXPECT_LE(hill_fault(nothing).below, 1e-12);
  EXPECT_LE(hill_fault(nothing).above, 1e-12);
}

TEST(tripwire_bracket, edges_tied_to_the_wrong_partners_are_noticed_by_the_shift_of_the_compliance)
{
  EXPECT_GT(shift_fault(tie_edges_to_the_wrong_partners), 1e-6);
}

TEST(tripwire_bracket,
     vertices_tied_to_the_wrong_partners_are_noticed_by_the_shift_of_the_compliance)
{
  EXPECT_GT(shift_fault(tie_vertices_to_the_wrong_partners), 1e-6);
}

TEST(tripwire_bracket, a_triangle_of_the_wrong_phase_is_noticed_by_hills_value_alone)
{
  EXPECT_LT(shift_fault(exchange_a_material), 1e-11); // another cell; the shift holds in any
  const HillFault hill = hill_fault(exchange_a_material);
  EXPECT_GT(std::max(hill.below, hill.above), 1e-3);
}

TEST(tripwire_bracket,
     the_wrong_sign_of_the_mixed_derivative_of_phi_is_noticed_by_the_loewner_order)
{
  // sigma_12 = Sigma_12 + phi,12 has, with P = diag(1, 1, −1), the energy of P c P under P Sigma:
  // compliance P S(P c P) P. Symmetric cells and the shift of the compliance pass it.
  const Eigen::Matrix3d P       = Eigen::Vector3d(1., 1., -1.).asDiagonal();
  const tests::BracketCell cell = fine_odd_cell(tests::contrasting(100.));
  std::vector<Eigen::Matrix3d> seen;
  for (const Eigen::Matrix3d &c : cell.stiffness)
    seen.emplace_back(P * c * P);
  const TorusMesh mesh = glued(cell.mesh, cell.lattice);
  const Bracket right = bracket(mesh, cell.stiffness, 2), mirrored = bracket(mesh, seen, 2);
  EXPECT_LE(violation(right.lower, right.upper), 0.);
  EXPECT_GT(violation(P * mirrored.lower * P, right.upper), 1e-2);
}
