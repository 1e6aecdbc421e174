// SPDX-License-Identifier: MIT
// What a plate does at its edges, against closed forms of stripes.
#include "homogenization/bracket/plate.h"
#include "homogenization/edges/edge_layers.h"
#include "meshes/plain/errors.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

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
  EdgeOptions options;
  options.order = 2;
  for (const double s : {0., 0.125, 0.5})
  {
    const UnitCell cell =
      cell_of(square_lattice(period), 3, 8, phases,
              [s](const double, const double f2) { return f2 > s && f2 < s + 0.5 ? 1 : 0; });
    const Eigen::Matrix3d D =
      solve_plate_cell(glued(cell.mesh, cell.lattice), cell.bending_stiffness_of_phase()).stiffness;
    Eigen::Matrix3d to_strain; // E = P^-1 D^H kappa
    to_strain << D.row(1), D.row(0), -2. * D.row(2);
    const meshes::CellEdge edge = edges_of_plate(cell, options).sides[2];
    const double lever          = period * (1. / 8. - s / 2.);
    // kappa22 = (M22 − D12 kappa11) / D22 in each, M22 = D^H_2a kappa_a in both.
    Eigen::RowVector3d slope = -(1. / soft(1, 1) - 1. / hard(1, 1)) * lever * D.row(1);
    slope(0) += (soft(0, 1) / soft(1, 1) - hard(0, 1) / hard(1, 1)) * lever;
    EXPECT_LT((edge.tension.transpose() * to_strain - slope).cwiseAbs().maxCoeff(), 1e-9 * period);
    // kappa of a free edge that is a beam: M22 = 0.
    const Eigen::Vector3d bent(1., -D(0, 1) / D(1, 1), 0.), twisted(0., 0., 1.);
    const double bending = lever * (free_strip(hard) - free_strip(soft)),
                 torsion = lever * (hard(2, 2) - soft(2, 2));
    EXPECT_NEAR((edge.slip * to_strain * bent)(1), bending, 1e-9 * period * free_strip(hard));
    // −2 (d_a E_a)_1 = −2 J 2 w,12: the beam turns with the slope along it.
    EXPECT_NEAR((edge.slip * to_strain * twisted)(0), -2. * torsion, 1e-9 * period * hard(2, 2));
  }
}

TEST(tripwire_plate_edges, are_refused_for_cells_with_holes)
{
  UnitCell cell                = cell_of(square_lattice(period), 6, 6, soft_and_hard(), halves);
  meshes::TriangleMesh pierced = cell.mesh;
  int kept                     = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (t / 12 != 2 || (t / 2) % 6 != 2) // one square
    {
      pierced.triangles.row(kept) = cell.mesh.triangles.row(t);
      pierced.material(kept++)    = cell.mesh.material(t);
    }
  pierced.triangles.conservativeResize(kept, 3);
  pierced.material.conservativeResize(kept);
  cell.mesh = pierced;
  EXPECT_THROW(edges_of_plate(cell, {}), meshes::BadInput);
}
