// SPDX-License-Identifier: MIT
#include "tests/verification/manufactured/following_cloth.h"

#include "meshes/plain/errors.h"
#include "shell/terms/external_term.h"
#include "shell/terms/membrane_term.h"
#include "tests/verification/manufactured/nodal_fields.h"
#include "verification/record/number_text.h"

#include <cmath>
#include <utility>

namespace homespun::verification
{
namespace
{
/// Forces on the vertices that are given functions of time.
class GivenForces : public shell::ExternalTerm
{
public:
  /// @param of_time [N] (n,3)
  /// @param share of the step at whose end the forces are taken: 1 for the Euler methods
  GivenForces(std::function<meshes::SpacePoints(double time)> of_time, const double share)
      : of_time(std::move(of_time))
      , share(share)
  {
  }
  std::string name() const override
  {
    return "given forces";
  }
  void begin_step(const shell::StepStart &start) override
  {
    forces = of_time(start.time + (std::isfinite(start.step) ? share * start.step : 0.));
  }
  double energy(const shell::Vectors &positions) const override
  {
    return forces.size() == 0 ? 0. : -forces.cwiseProduct(positions).sum();
  }
  void add_gradient(const shell::Vectors &, shell::Vectors &gradient) const override
  {
    if (forces.size() != 0)
      gradient -= forces;
  }
  void add_derivatives(const shell::Vectors &, shell::Hessian, shell::Vectors &gradient,
                       shell::BlockMatrix &) const override
  {
    gradient -= forces;
  }
  bool has_discrete_gradient() const override
  {
    return true;
  }
  void add_discrete_gradient(const shell::Vectors &, const shell::Vectors &,
                             shell::Vectors &gradient, shell::VertexMatrix &) const override
  {
    gradient -= forces;
  }
  std::size_t bytes() const override
  {
    return static_cast<std::size_t>(forces.size()) * sizeof(double);
  }

private:
  const std::function<meshes::SpacePoints(double time)> of_time;
  const double share;
  meshes::SpacePoints forces;
};

meshes::ClothMesh mesh_at(const GradedSheet &sheet, const SheetMotion &motion)
{
  return {sheet.rest, positions_of(sheet.rest, at_time(motion, 0.)), sheet.rest.triangles};
}
} // namespace

NamedStiffness uniform(const Eigen::Matrix3d &stiffness)
{
  return {"homogeneous", [=](const Eigen::RowVector2d &) { return stiffness; }};
}

NamedStiffness graded(const Eigen::Matrix3d &stiffness)
{
  return {"heterogeneous",
          [=](const Eigen::RowVector2d &point) { return varied(stiffness, point); }};
}

GradedSheet sheet_of(const int n, const NamedStiffness &stiffness)
{
  GradedSheet sheet;
  sheet.rest = irregular_mesh(n);
  for (int t = 0; t < sheet.rest.n_triangles(); ++t)
  {
    Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      centre += sheet.rest.vertices.row(sheet.rest.triangles(t, k)) / 3.;
    sheet.stiffness.push_back(stiffness.at(centre));
    sheet.rest.material(t) = t;
  }
  for (int v = 0; v < sheet.rest.n_vertices(); ++v)
    if (const Eigen::RowVector2d point = sheet.rest.vertices.row(v);
        point.minCoeff() < 1e-9 * manufactured_side ||
        point.maxCoeff() > (1. - 1e-9) * manufactured_side)
      sheet.rim.push_back(v);
  return sheet;
}

Eigen::VectorXd GradedSheet::masses() const
{
  const std::vector<double> densities(stiffness.size(), manufactured_density);
  const auto flat =
    meshes::placed_sheet(rest, Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
  return shell::lumped_masses(flat, densities);
}

meshes::SpacePoints positions_of(const meshes::TriangleMesh &rest, const KnownField &motion)
{
  meshes::SpacePoints positions(rest.n_vertices(), 3);
  for (int v = 0; v < rest.n_vertices(); ++v)
    positions.row(v) = motion.value(rest.vertices.row(v)).transpose();
  return positions;
}

FollowingCloth::FollowingCloth(const GradedSheet &sheet, const SheetMotion &motion,
                               const shell::ClothOptions &options,
                               std::function<meshes::SpacePoints(double time)> forces)
    : sheet(sheet)
    , motion(motion)
    , cloth(mesh_at(sheet, motion).positions, sheet.masses(), sheet.rim, options)
{
  cloth.add(shell::membrane_term(mesh_at(sheet, motion), sheet.stiffness));
  cloth.add(std::make_unique<GivenForces>(
    std::move(forces), options.integrator == shell::Integrator::conserving ? 0.5 : 1.));
}

void FollowingCloth::take_steps(const int n_steps, const double dt)
{
  for (int k = 1; k <= n_steps; ++k)
  {
    hold_at(k * dt);
    if (const shell::StepReport report = cloth.step(dt); report.cuts != 0)
      throw meshes::NotConverged("a step of " + short_text(dt) + " s was cut", {});
  }
}

void FollowingCloth::find_equilibrium(const double tolerance)
{
  hold_at(0.);
  cloth.solve_equilibrium(tolerance);
}

ManufacturedSolution FollowingCloth::compared(const SheetMotion &exact) const
{
  const meshes::SpacePoints found = cloth.positions();
  return {distance(sheet.rest, found, at_time(exact, cloth.time())),
          static_cast<unsigned long>(found.size()), found};
}

ManufacturedSolution FollowingCloth::compared_at_vertices(const SheetMotion &exact) const
{
  const meshes::SpacePoints found = cloth.positions();
  const meshes::SpacePoints known = positions_of(sheet.rest, at_time(exact, cloth.time()));
  const double mean = std::sqrt((found - known).squaredNorm() / static_cast<double>(found.rows()));
  return {{manufactured_side * mean, 0.}, static_cast<unsigned long>(found.size()), found};
}

void FollowingCloth::hold_at(const double time)
{
  for (const int v : sheet.rim)
    cloth.prescribe(v, motion(sheet.rest.vertices.row(v), time).value.transpose());
}
} // namespace homespun::verification
