// SPDX-License-Identifier: MIT
// What a plate does at its edges, against closed forms of stripes.
#include "homogenization/bracket/plate.h"
#include "homogenization/edges/edge_layers.h"
#include "homogenization/edges/plate_edges.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace homespun;
using namespace homespun::homogenization;
using namespace homespun::tests;

namespace
{
constexpr double period = 0.01;
}

// With a soft layer of thickness s eps outermost, then a full hard one, a clamped edge along it
// turns by b_a kappa_a, b_a = (1/D22_s − 1/D22_h) eps (s/2 − 1/8) D^H_2a, and a free one is a beam
// of bending and torsion B = eps (D*_h − D*_s)(1/8 − s/2), D* = D11 − D12²/D22, and J = eps (D66_h
// − D66_s)(1/8 − s/2).
TEST(exact_plate_edges, along_stripes_have_their_closed_forms)
{
  const std::vector<Phase> phases = {isotropic("soft", 1e6, 0.2, 5e-4, 1.),
                                     isotropic("hard", 1e7, 0.45, 5e-4, 1.)};
  const Eigen::Matrix3d soft = bending_stiffness(phases[0]), hard = bending_stiffness(phases[1]);
  const auto free_strip = [](const Eigen::Matrix3d &D)
  { return D(0, 0) - D(0, 1) * D(0, 1) / D(1, 1); };
  for (const double s : {0., 0.125, 0.5})
  {
    const UnitCell cell =
      cell_of(square_lattice(period), 3, 8, phases,
              [s](const double, const double f2) { return f2 > s && f2 < s + 0.5 ? 1 : 0; });
    const Eigen::Matrix3d D =
      solve_plate_cell(glued(cell.mesh, cell.lattice), cell.bending_stiffness_of_phase()).stiffness;
    const PlateEdge edge = edges_of_plate(cell, {}).sides[2];
    const double lever   = period * (1. / 8. - s / 2.);
    // kappa22 = (M22 − D12 kappa11) / D22 in each, M22 = D^H_2a kappa_a in both.
    Eigen::RowVector3d slope = -(1. / soft(1, 1) - 1. / hard(1, 1)) * lever * D.row(1);
    slope(0) += (soft(0, 1) / soft(1, 1) - hard(0, 1) / hard(1, 1)) * lever;
    EXPECT_LT((edge.slip.slope - slope).cwiseAbs().maxCoeff(), 1e-9 * period);
    // kappa of a free edge that is a beam: M22 = 0. Its energy is ½ K.m(K).
    const Eigen::Vector3d bent(1., -D(0, 1) / D(1, 1), 0.), twisted(0., 0., 1.);
    const double bending = lever * (free_strip(hard) - free_strip(soft)),
                 torsion = lever * (hard(2, 2) - soft(2, 2));
    EXPECT_NEAR((edge.moment * bent)(0), bending, 1e-9 * period * free_strip(hard));
    EXPECT_NEAR((edge.moment * twisted)(2), torsion, 1e-9 * period * hard(2, 2));
    EXPECT_LT(edge.clamped.cwiseAbs().maxCoeff(), 1e-9 * period) << "no layer";
  }
}

namespace
{
/// A part that has no symmetry at all.
int lopsided_part(const double f1, const double f2)
{
  return f1 > 0.25 && f1 < 0.75 && f2 > 0.125 && f2 < (f1 < 0.5 ? 0.5 : 0.75) ? 1 : 0;
}

/// The cell whose membrane is the analogous one of a plate: E' = 12 (1 − nu²)/(E t³), nu' = −nu.
UnitCell analogous(UnitCell cell)
{
  for (Phase &phase : cell.phases)
    phase = isotropic(
      phase.name, 12. * (1. - phase.nu12 * phase.nu12) / (phase.E1 * std::pow(phase.thickness, 3)),
      -phase.nu12, 1., 1.);
  return cell;
}

Eigen::Matrix3d stiffness_of(const UnitCell &cell)
{
  return solve_plate_cell(glued(cell.mesh, cell.lattice), cell.bending_stiffness_of_phase())
    .stiffness;
}

Eigen::Vector2d inwards(const std::size_t side, const meshes::Lattice &lattice)
{
  const auto axis             = static_cast<int>(side / 2);
  const Eigen::Vector2d along = lattice.vectors.row(1 - axis).normalized();
  const Eigen::Vector2d n(-along(1), along(0));
  const bool is_near = side % 2 == 0;
  return (lattice.vectors.row(axis).dot(n) > 0.) == is_near ? n : Eigen::Vector2d(-n);
}

/// Bending along an edge and twisting, with the curvature across it that leaves it without moment.
Eigen::Matrix<double, 3, 2> free_of_moment_across(const Eigen::Vector2d &n,
                                                  const Eigen::Matrix3d &D)
{
  const Eigen::Vector2d t(n(1), -n(0));
  const Eigen::RowVector3d across(n(0) * n(0), n(1) * n(1), 2. * n(0) * n(1));
  Eigen::Matrix<double, 3, 2> K;
  K << t(0) * t(0), t(0) * n(0), t(1) * t(1), t(1) * n(1), 2. * t(0) * t(1),
    t(0) * n(1) + t(1) * n(0);
  K -= across.transpose() * (across * D * K) / across.dot(across * D);
  return K;
}

UnitCell lopsided(const int n)
{
  return cell_of(skewed_lattice(), n, n,
                 {isotropic("soft", 1e6, 0.2, 5e-4, 1.), isotropic("hard", 1e7, 0.4, 5e-4, 1.)},
                 lopsided_part);
}

/// The largest difference between the slips of a plate and the tensions of its analogous membrane,
/// between the beams and the slips, and between the bulk terms, each over the largest of them.
Eigen::Vector3d distance_of_analogy(const int n)
{
  const UnitCell cell    = lopsided(n);
  const PlateEdges plate = edges_of_plate(cell, {});
  EdgeOptions options;
  options.order                    = 2;
  const meshes::CellEdges membrane = edges_of(analogous(cell), options);
  const Eigen::Matrix3d D          = stiffness_of(cell);
  Eigen::Matrix3d to_strain; // E = P^-1 D^H kappa
  to_strain << D.row(1), D.row(0), -2. * D.row(2);
  Eigen::Vector3d difference = Eigen::Vector3d::Zero(), size = Eigen::Vector3d::Zero();
  const auto add = [&](const int what, const auto &one, const auto &other)
  {
    difference(what) = std::max(difference(what), (one - other).cwiseAbs().maxCoeff());
    size(what)       = std::max(size(what), one.cwiseAbs().maxCoeff());
  };
  for (int side = 0; side < 4; ++side)
  {
    const auto of_side = static_cast<std::size_t>(side);
    add(0, plate.sides[of_side].slip.slope.eval(),
        (membrane.sides[of_side].tension.transpose() * to_strain).eval());
    // Along the edge with the sheet on the left, and to the left.
    const Eigen::Vector2d n             = inwards(of_side, cell.lattice), t(n(1), -n(0));
    const Eigen::Matrix<double, 3, 2> K = free_of_moment_across(n, D),
                                      m = plate.sides[of_side].moment * K;
    const Eigen::Matrix2d d             = membrane.sides[of_side].slip * to_strain * K;
    for (int k = 0; k < 2; ++k)
    {
      Eigen::Matrix2d tensor;
      tensor << m(0, k), m(2, k), m(2, k), m(1, k);
      add(1, Eigen::Vector2d(t.dot(tensor * t), -2. * t.dot(tensor * n)),
          Eigen::Vector2d(n.dot(d.col(k)), t.dot(d.col(k))));
    }
  }
  for (std::size_t b = 0; b < 2; ++b) // −M_abc kappa_c(v) = M'_abc E_a (P^-1 D kappa(v))_c
    add(2, plate.bulk[b], Eigen::Matrix3d(-to_strain.transpose() * membrane.bulk[b] * to_strain));
  return difference.cwiseQuotient(size);
}

/// Without the triangles of its last phase.
UnitCell pierced(const UnitCell &cell)
{
  UnitCell result = cell;
  std::vector<int> number(static_cast<std::size_t>(cell.mesh.n_vertices()), -1);
  int n_triangles = 0, n_vertices = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (cell.mesh.material(t) + 1 < static_cast<int>(cell.phases.size()))
    {
      for (int k = 0; k < 3; ++k)
      {
        const int v = cell.mesh.triangles(t, k);
        int &its    = number[static_cast<std::size_t>(v)];
        if (its < 0)
        {
          its                           = n_vertices++;
          result.mesh.vertices.row(its) = cell.mesh.vertices.row(v);
        }
        result.mesh.triangles(n_triangles, k) = its;
      }
      result.mesh.material(n_triangles++) = cell.mesh.material(t);
    }
  result.mesh.vertices.conservativeResize(n_vertices, 2);
  result.mesh.triangles.conservativeResize(n_triangles, 3);
  result.mesh.material.conservativeResize(n_triangles);
  result.phases.pop_back();
  return result;
}
} // namespace

// Tensions and slips of the analogous membrane, another element and other unknowns, are slips and
// beams of the plate.
TEST(order_plate_edges, come_to_those_of_the_analogous_membrane)
{
  const Eigen::Vector3d coarse = distance_of_analogy(8), fine = distance_of_analogy(16),
                        finer = distance_of_analogy(32);
  for (int k = 0; k < 3; ++k) // of order one at least, beside corners of phases
  {
    EXPECT_LT(fine(k), 0.5 * coarse(k)) << k;
    EXPECT_LT(finer(k), 0.5 * fine(k)) << k;
  }
}

// On the edge the plate stays as it is clamped: c_a and b_a are what is left far inside.
TEST(invariant_plate_edges, clamped_modes_cancel_the_deflection_on_the_edge_and_decay)
{
  const UnitCell cell   = lopsided(8);
  const TorusMesh torus = glued(cell.mesh, cell.lattice);
  const PlateCell bent  = solve_plate_cell(torus, cell.bending_stiffness_of_phase());
  EdgeOptions options;
  options.kept           = 1e-9;
  const PlateEdges edges = edges_of_plate(cell, options);
  const Eigen::MatrixX2d fractions =
    (cell.mesh.vertices.rowwise() - cell.mesh.vertices.row(0)) * cell.lattice.vectors.inverse();
  for (std::size_t side = 0; side < 4; ++side)
  {
    const PlateEdge &edge   = edges.sides[side];
    const Eigen::Vector2d n = inwards(side, cell.lattice);
    for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    {
      if (std::abs(fractions(v, static_cast<int>(side / 2)) - static_cast<double>(side % 2)) > 1e-9)
        continue;
      const int glued_vertex = torus.vertex_of_original[static_cast<std::size_t>(v)];
      for (int a = 0; a < 3; ++a)
      {
        Eigen::Vector3d expected = -bent.deflection.block<3, 1>(3 * glued_vertex, a);
        expected(0) -= edge.slip.value(a);
        expected.tail<2>() -= edge.slip.slope(a) * n;
        const Eigen::Vector3d mode = edge.clamped.row(v).segment<3>(3 * a);
        EXPECT_LT(std::abs(mode(0) - expected(0)), 1e-9 * period * period) << side;
        EXPECT_LT((mode - expected).tail<2>().norm(), 1e-9 * period) << side;
      }
    }
    const int n_vertices = cell.mesh.n_vertices();
    EXPECT_LT(edge.clamped.bottomRows(n_vertices).cwiseAbs().maxCoeff(),
              1e-4 * edge.clamped.topRows(n_vertices).cwiseAbs().maxCoeff());
  }
}

// A hole is what a part becomes that is weaker and weaker.
TEST(exact_plate_edges, of_a_hole_are_those_of_a_part_without_stiffness)
{
  const UnitCell weak =
    cell_of(square_lattice(period), 8, 8,
            {isotropic("soft", 1e6, 0.2, 5e-4, 1.), isotropic("hard", 1e7, 0.4, 5e-4, 1.),
             isotropic("weak", 1e-2, 0.3, 5e-4, 1.)},
            [](const double f1, const double f2) {
              return std::abs(f1 - 0.5) < 0.25 && std::abs(f2 - 0.4) < 0.2 ? 2 : f1 < 0.4 ? 0 : 1;
            });
  const UnitCell cell     = pierced(weak);
  const Eigen::Matrix3d D = stiffness_of(cell);
  const PlateEdges edges = edges_of_plate(cell, {}), expected = edges_of_plate(weak, {});
  constexpr double contrast = 1e-8;
  for (std::size_t side = 0; side < 4; ++side)
  {
    const PlateEdge &one = edges.sides[side], &other = expected.sides[side];
    EXPECT_LT((one.slip.slope - other.slip.slope).norm(), 10. * contrast * one.slip.slope.norm());
    const auto along = free_of_moment_across(inwards(side, cell.lattice), D);
    EXPECT_LT(((one.moment - other.moment) * along).norm(),
              10. * contrast * (one.moment * along).norm());
  }
  for (std::size_t b = 0; b < 2; ++b)
    EXPECT_LT((edges.bulk[b] - expected.bulk[b]).norm(), 10. * contrast * edges.bulk[b].norm());
}
