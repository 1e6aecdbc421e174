// SPDX-License-Identifier: MIT
// Time steps, stiffness, starts.
#include "verification/extremes/stress_cases.h"

#include "verification/record/number_text.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace homespun::verification
{
using shell::Cloth;
using shell::Vectors;

namespace
{
constexpr int n_steps_at_rest = 20000;
constexpr double side         = 0.2; ///< of the sheet [m]

const Derivations derivations_of_sheets = {
  {growth_of_energy, of_energy},
  {largest_way,
   "theory: a sheet at rest stays; round-off: 2.2e-16 of its side of 0.2 m in each of 20000 "
   "steps"}};

/// A sheet hung by its upper corners that must not gain energy.
StressAnswer hang(const SheetStiffness &stiffness, const double h, const int n_steps,
                  const double disturbance, const unsigned int seed)
{
  const meshes::ClothMesh mesh = hanging_mesh(cells_per_side);
  Cloth cloth                  = sheet_cloth(mesh, stiffness, upper_corners(cells_per_side));
  Vectors velocities           = disturbance * meshes::random_vectors(mesh.n_vertices(), seed);
  for (const int v : upper_corners(cells_per_side))
    velocities.row(v).setZero();
  cloth.set_state(mesh.positions, velocities, 0.);
  const double growth = largest_energy_growth(cloth, h, n_steps);
  return {growth, state_of(cloth)};
}

/// Drift of a sheet that rests.
StressAnswer rest(const meshes::ClothMesh &mesh, const SheetStiffness &stiffness,
                  const std::vector<int> &held, const SheetPhysics &physics, const bool settle)
{
  Cloth cloth = sheet_cloth(mesh, stiffness, held, physics);
  if (settle)
    cloth.solve_equilibrium(1e-12);
  const Vectors before = cloth.positions();
  for (int k = 0; k < n_steps_at_rest; ++k)
    cloth.step(0.01);
  return {(cloth.positions() - before).rowwise().norm().maxCoeff(), state_of(cloth)};
}

struct Start
{
  const char *name;
  bool is_random;
  Vectors (*of)(const meshes::ClothMesh &mesh, unsigned int seed);
  bool is_point = false;
};

/// The flat sheet with one factor per direction.
Vectors scaled(const meshes::ClothMesh &mesh, const Eigen::Vector3d &factors)
{
  return mesh.positions * factors.asDiagonal();
}

const std::vector<Start> starts = {
  {"random vertices", true,
   [](const meshes::ClothMesh &mesh, const unsigned int seed) -> Vectors
   { return 0.2 * meshes::random_vectors(mesh.n_vertices(), seed); }},
  {"flattened to another plane", false,
   [](const meshes::ClothMesh &mesh, unsigned int) -> Vectors
   {
     // The hanging sheet is in the plane of 1 and 3: sheared into that of 1 and 2, half as high.
     Eigen::Matrix3d A;
     A << 1., 0., 0., 0., 0., 0., 0., 0.5, 0.;
     return mesh.positions * A;
   }},
  {"flattened to a line", false,
   [](const meshes::ClothMesh &mesh, unsigned int) {
     return scaled(mesh, {1., 0., 0.});
   }},
  {"flattened to a line across the grain", false,
   [](const meshes::ClothMesh &mesh, unsigned int) -> Vectors
   { return mesh.positions.rowwise().sum() * Eigen::RowVector3d(0.4, 0.5, -0.3); }},
  {"flattened to a point", false,
   [](const meshes::ClothMesh &mesh, unsigned int) {
     return scaled(mesh, {0., 0., 0.});
   },
   true},
  {"mirrored", false,
   [](const meshes::ClothMesh &mesh, unsigned int) {
     return scaled(mesh, {-1., 1., 1.});
   }},
  {"folded by 180 degrees", false,
   [](const meshes::ClothMesh &mesh, unsigned int)
   {
     const double middle = 0.5 * mesh.positions.col(2).maxCoeff();
     Vectors x           = mesh.positions;
     x.col(2)            = middle + (x.col(2).array() - middle).abs();
     return x;
   }},
  {"one vertex at 1e6 m", true,
   [](const meshes::ClothMesh &mesh, const unsigned int seed)
   {
     Vectors x = mesh.positions;
     x.row(static_cast<int>(seed * 7 + 3) % mesh.n_vertices()) << 1e6, -2e5, 3e5;
     return x;
   }},
  {"every second triangle inverted", false,
   [](const meshes::ClothMesh &mesh, unsigned int)
   {
     // Three colours of vertices, all triangles upon one: those above the diagonals come to lie
     // upside down.
     const Eigen::Matrix3d corners =
       (Eigen::Matrix3d() << 0., 0., 0., 1., 0., 0., 0., 0., 1.).finished();
     Vectors x(mesh.n_vertices(), 3);
     for (int j = 0; j <= cells_per_side; ++j)
       for (int i = 0; i <= cells_per_side; ++i)
         x.row(j * (cells_per_side + 1) + i) = 0.2 / cells_per_side * corners.row((i + j) % 3);
     return x;
   }},
  {"two vertices coincident", true,
   [](const meshes::ClothMesh &mesh, const unsigned int seed)
   {
     Vectors x         = mesh.positions;
     const int between = static_cast<int>(seed) % (cells_per_side - 1) +
                         (cells_per_side + 1) * (1 + static_cast<int>(seed) % (cells_per_side - 2));
     x.row(between) = x.row(between + 1);
     return x;
   }},
};

StressAnswer start_from(const Start &start, const SheetStiffness &stiffness, const double h,
                        const bool is_free, const unsigned int seed)
{
  const meshes::ClothMesh mesh = hanging_mesh(cells_per_side);
  const std::vector<int> held  = is_free ? std::vector<int>() : upper_corners(cells_per_side);
  Cloth cloth                  = sheet_cloth(mesh, stiffness, held);
  Vectors x                    = start.of(mesh, seed);
  for (const int v : held)
    x.row(v) = mesh.positions.row(v);
  cloth.set_state(x, Vectors::Zero(x.rows(), 3), 0.);
  const double growth = largest_energy_growth(cloth, h, 30);
  return {growth, state_of(cloth)};
}
} // namespace

std::vector<StressCase> time_step_cases(const std::vector<SheetStiffness> &stiffnesses)
{
  std::vector<StressCase> cases;
  CaseGroup group("time step", cases);
  for (const SheetStiffness &stiffness : stiffnesses)
  {
    for (const double h : {1e-5, 1e-4, 1e-3, 1e-2, 5e-2, 0.1, 1.})
      for (const double disturbance : {0., 2.})
        group
          .finite(short_text(h) + " s; " +
                    (disturbance > 0. ? "random velocities of 2 m/s; " : "from rest; ") +
                    stiffness.name,
                  never_grows, {energy_round_off, growth_of_energy},
                  [=](const unsigned int seed)
                  { return hang(stiffness, h, h < 0.05 ? 60 : 30, disturbance, seed); })
          .is_random = disturbance > 0.;
  }
  const SheetStiffness &first = stiffnesses.front();
  SheetPhysics weightless;
  weightless.gravity.setZero();
  const auto rests = [&](const std::string &name, const meshes::ClothMesh &mesh,
                         const std::vector<int> &held, const SheetPhysics &physics,
                         const bool settle)
  {
    group.finite("20000 steps at rest; " + name, "finite; does not drift",
                 {n_steps_at_rest * std::numeric_limits<double>::epsilon() * side, largest_way},
                 [=](unsigned int) { return rest(mesh, first, held, physics, settle); });
  };
  rests("free; flat; no gravity", lying_mesh(2), {}, weightless, false);
  meshes::ClothMesh turned = lying_mesh(2);
  turned.positions =
    turned.positions *
    Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., 2.) / 3.).toRotationMatrix().transpose();
  rests("free; turned by 0.7; no gravity", turned, {}, weightless, false);
  rests("hung by two corners; in equilibrium", hanging_mesh(2), upper_corners(2), {}, true);
  derive(cases, derivations_of_sheets);
  return cases;
}

std::vector<StressCase> stiffness_cases()
{
  std::vector<StressCase> cases;
  CaseGroup group("stiffness", cases);
  for (const double young : {1e-2, 1., 1e2, 1e4, 1e6, 1e8})
    for (const double density : {0.01, 0.1, 1., 10.})
    {
      SheetStiffness stiffness = isotropic_sheet(young, 0.3);
      stiffness.areal_density  = density;
      group
        .finite(short_text(young) + " N/m; " + short_text(density) + " kg/m^2", never_grows,
                {energy_round_off, growth_of_energy},
                [=](const unsigned int seed) { return hang(stiffness, 0.005, 50, 2., seed); })
        .is_random = true;
    }
  derive(cases, derivations_of_sheets);
  return cases;
}

std::vector<StressCase> start_cases(const std::vector<SheetStiffness> &stiffnesses)
{
  std::vector<StressCase> cases;
  CaseGroup group("start", cases);
  for (const Start &start : starts)
    for (const SheetStiffness &stiffness : stiffnesses)
      for (const bool is_free : {false, true})
        for (const double h : {1e-3, 0.02})
        {
          const std::string name = std::string(start.name) +
                                   (is_free ? "; free; " : "; hung by two corners; ") +
                                   short_text(1e3 * h) + " ms; " + stiffness.name;
          const auto run = [=](const unsigned int seed)
          { return start_from(start, stiffness, h, is_free, seed); };
          // Without length a yarn has an infinite energy, and nothing pulls it out of a point.
          if (start.is_point && is_free && stiffness.law == meshes::Law::yarn)
            group.refused(name, "a yarn without length", run);
          else
            group.finite(name, never_grows, {energy_round_off, growth_of_energy}, run).is_random =
              start.is_random;
        }
  derive(cases, derivations_of_sheets);
  return cases;
}
} // namespace homespun::verification
