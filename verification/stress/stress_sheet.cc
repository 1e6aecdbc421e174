// SPDX-License-Identifier: MIT
#include "verification/stress/stress_sheet.h"

#include "meshes/plain/sheet.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/yarn_term.h"
#include "verification/ellipticity/default_law.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
SheetStiffness isotropic_sheet(const double young, const double poisson)
{
  Eigen::Matrix3d D;
  D << 1., poisson, 0., poisson, 1., 0., 0., 0., 0.5 * (1. - poisson);
  return {"isotropic", young / (1. - poisson * poisson) * D};
}

std::vector<SheetStiffness> built_in_stiffnesses()
{
  Eigen::Matrix3d laminate;
  laminate << 2840., 300., 0., 300., 999., 0., 0., 0., 350.;
  const Eigen::Matrix3d Q = (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitZ()))
                              .toRotationMatrix();
  const Eigen::Matrix3d skewed = Q * Eigen::Vector3d(1e4, 30., 1.).asDiagonal() * Q.transpose();
  return {isotropic_sheet(1000., 0.3),
          {"laminate", laminate},
          {"anisotropic 1e4", 0.5 * (skewed + skewed.transpose())}};
}

std::vector<SheetStiffness> with_twins_of_yarn(const std::vector<SheetStiffness> &stiffnesses)
{
  std::vector<SheetStiffness> all = stiffnesses;
  for (SheetStiffness twin : stiffnesses)
    if (loss_of_biot(twin.D).strain < largest_strain_of_cloth)
    {
      twin.name += ", yarn";
      twin.law = meshes::Law::yarn;
      all.push_back(twin);
    }
  return all;
}

meshes::ClothMesh hanging_mesh(const int n)
{
  Eigen::Matrix<double, 3, 2> placement;
  placement << 1., 0., 0., 0., 0., 1.;
  return meshes::placed_sheet(meshes::irregular_sheet(n, sheet_side), placement,
                              Eigen::RowVector3d::Zero());
}

meshes::ClothMesh lying_mesh(const int n)
{
  return meshes::placed_sheet(meshes::irregular_sheet(n, sheet_side),
                              Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
}

std::vector<int> upper_corners(const int n)
{
  return {n * (n + 1), (n + 1) * (n + 1) - 1};
}

shell::Cloth sheet_cloth(const meshes::ClothMesh &mesh, const SheetStiffness &stiffness,
                         const std::vector<int> &held, const SheetPhysics &physics)
{
  const std::vector<Eigen::Matrix3d> D = {stiffness.D, stiffness.thicker * stiffness.D};
  const Eigen::VectorXd masses =
    shell::lumped_masses(mesh, {stiffness.areal_density,
                                stiffness.areal_density * stiffness.thicker * stiffness.denser});
  shell::Cloth cloth(mesh.positions, masses, held, physics.options);
  if (stiffness.law == meshes::Law::yarn)
  {
    cloth.add(shell::yarn_term(mesh, D));
    if (physics.viscosity > 0.)
      cloth.add(shell::viscosity_term(mesh, D, physics.viscosity));
  }
  else
    cloth.add(shell::membrane_term(mesh, D, physics.viscosity));
  if (physics.damping > 0.)
    cloth.add(shell::mass_damping_term(masses, physics.damping));
  if (!physics.gravity.isZero(0.))
    cloth.add(shell::gravity_term(masses, physics.gravity));
  return cloth;
}

Eigen::MatrixXd state_of(const shell::Cloth &cloth)
{
  Eigen::MatrixXd state(cloth.positions().rows(), 6);
  state << cloth.positions(), cloth.velocities();
  return state;
}

double largest_energy_growth(shell::Cloth &cloth, const double h, const int n_steps)
{
  double before  = cloth.kinetic_energy() + cloth.stored_energy();
  double largest = cloth.kinetic_energy() + std::abs(cloth.stored_energy());
  double growth  = 0.;
  for (int k = 0; k < n_steps; ++k)
  {
    cloth.step(h);
    const double after = cloth.kinetic_energy() + cloth.stored_energy();
    growth             = std::max(growth, after - before);
    largest = std::max(largest, cloth.kinetic_energy() + std::abs(cloth.stored_energy()));
    before  = after;
  }
  return growth > 0. ? growth / largest : 0.;
}
} // namespace homespun::verification
