// SPDX-License-Identifier: MIT
// The cloth of shell/ against motions that it must reproduce: its equilibria in the plane and in
// space, steps in time on finer and finer meshes, and finer and finer steps on one mesh.
#include "shell/solver/equilibrium.h"
#include "tests/verification/manufactured/following_cloth.h"
#include "tests/verification/manufactured/manufactured.h"
#include "tests/verification/manufactured/manufactured_cases.h"
#include "tests/verification/manufactured/nodal_fields.h"

#include <cmath>

namespace homespun::verification
{
namespace
{
const std::vector<int> mesh_sizes = {6, 12, 24, 48};

/// −Div P per rest area.
FieldValue elastic_force(const Law law, const StiffnessField &stiffness, const KnownField &motion,
                         const Eigen::RowVector2d &point)
{
  return equilibrium_force(law, stiffness, motion.gradient, point, manufactured_difference);
}

/// A strip that is stretched by 10 % along axis 2, clamped at both ends, free at its sides.
ManufacturedCase plane_case(const Law law, const NamedStiffness &stiffness)
{
  ManufacturedCase result =
    of_elements("shell in the plane; " + stiffness.name + "; " + name_of(law), 1, mesh_sizes);
  result.has_tolerance = law != Law::linear;
  result.solve         = [=](const int n, const double solver_tolerance, MPI_Comm)
  {
    constexpr double strain = 0.1;
    KnownField motion;
    motion.value = [](const Eigen::RowVector2d &point)
    {
      return FieldValue(clamped_wave(point, strain).value +
                        FieldValue(point(0), (1. + strain) * point(1), 0.));
    };
    motion.gradient = [](const Eigen::RowVector2d &point)
    {
      FieldGradient F = clamped_wave(point, strain).gradient;
      F.topRows<2>() += Eigen::Vector2d(1., 1. + strain).asDiagonal().toDenseMatrix();
      return F;
    };
    const GradedSheet sheet = sheet_of(n, stiffness);
    const meshes::Points loads =
      nodal_loads(sheet.rest, [&](const Eigen::RowVector2d &point)
                  { return elastic_force(law, stiffness.at, motion, point); })
        .leftCols<2>();
    std::vector<int> clamped;
    shell::Positions<2> start = sheet.rest.vertices;
    for (const int v : sheet.rim)
      if (const double y = sheet.rest.vertices(v, 1) / manufactured_side;
          std::abs(y - 0.5) > 0.5 - 1e-9)
      {
        clamped.push_back(v);
        start(v, 1) *= 1. + strain;
      }
    const shell::MembraneSolver solver(shell::membrane(sheet.rest, sheet.stiffness), clamped);
    shell::EquilibriumOptions options;
    options.relative_tolerance = solver_tolerance;
    meshes::SpacePoints found  = meshes::SpacePoints::Zero(sheet.rest.n_vertices(), 3);
    found.leftCols<2>()        = law == Law::linear
                                   ? solver.solve_linear(start, loads)
                                   : solver.solve_equilibrium(start, options, loads).positions;
    return ManufacturedSolution{distance(sheet.rest, found, motion),
                                static_cast<unsigned long>(2 * sheet.rest.n_vertices()), found};
  };
  return result;
}

shell::ClothOptions cloth_options(const shell::Integrator integrator, const double tolerance)
{
  shell::ClothOptions options;
  options.integrator       = integrator;
  options.newton_tolerance = tolerance;
  return options;
}

ManufacturedCase static_case(const NamedStiffness &stiffness)
{
  ManufacturedCase result =
    of_elements("shell in space; statics; " + stiffness.name + "; biot", 1, mesh_sizes);
  result.solve = [=](const int n, const double solver_tolerance, MPI_Comm)
  {
    const GradedSheet sheet = sheet_of(n, stiffness);
    // The start is half as high as what is to be found.
    const SheetMotion start = [](const Eigen::RowVector2d &point, double)
    { return bulging(point, 0.5 * full_height); };
    const SheetMotion exact = [](const Eigen::RowVector2d &point, double)
    { return bulging(point, full_height); };
    const meshes::SpacePoints loads =
      nodal_loads(sheet.rest, [&](const Eigen::RowVector2d &point)
                  { return elastic_force(Law::biot, stiffness.at, at_time(exact, 0.), point); });
    FollowingCloth cloth(sheet, start, cloth_options(shell::Integrator::implicit, solver_tolerance),
                         [&](double) { return loads; });
    cloth.find_equilibrium(solver_tolerance);
    return cloth.compared(exact);
  };
  return result;
}

/// Four steps of implicit Euler on a motion whose force contains the scheme's own difference
/// quotient,
///   f_n = rho (x_n − 2 x_(n−1) + x_(n−2)) / h² − Div P(x_n),   x_(−1) = x_0,
/// so that the steps are exact and what remains is the error of the elements.
ManufacturedCase stepping_case(const NamedStiffness &stiffness)
{
  ManufacturedCase result =
    of_elements("shell in space; steps; " + stiffness.name + "; biot", 1, mesh_sizes);
  result.solve = [=](const int n, const double solver_tolerance, MPI_Comm)
  {
    constexpr double dt      = 2e-3;
    constexpr int n_steps    = 4;
    const SheetMotion motion = [](const Eigen::RowVector2d &point, const double time)
    {
      const double part = std::max(0., time) / (n_steps * dt);
      return bulging(point, full_height * part * part);
    };
    const GradedSheet sheet = sheet_of(n, stiffness);
    const auto force        = [&](const Eigen::RowVector2d &point, const double time) -> FieldValue
    {
      const FieldValue acceleration =
        (motion(point, time).value - 2. * motion(point, time - dt).value +
         motion(point, time - 2. * dt).value) /
        (dt * dt);
      return manufactured_density * acceleration +
             elastic_force(Law::biot, stiffness.at, at_time(motion, time), point);
    };
    FollowingCloth cloth(sheet, motion,
                         cloth_options(shell::Integrator::implicit, solver_tolerance),
                         [&](const double time)
                         {
                           return nodal_loads(sheet.rest, [&](const Eigen::RowVector2d &point)
                                              { return force(point, time); });
                         });
    cloth.take_steps(n_steps, dt);
    return cloth.compared(motion);
  };
  return result;
}

/// One mesh, whose vertices follow a motion exactly:
///   f_i = m_i x_i'' + sum over triangles of A P(F) grad N_i,
/// with P of the energy written apart, so that only the time steps err.
ManufacturedCase time_case(const std::string &name, const shell::Integrator integrator,
                           const double order)
{
  constexpr double turn = 4e-3, end = 2.4e-3; // [s]; the inside lags most in the midst of the turn
  const NamedStiffness stiffness = graded(anisotropic());
  ManufacturedCase result =
    of_time_steps("shell in space; " + name + " in time; " + stiffness.name + "; biot", order,
                  {16, 32, 64, 128, 256}, end);
  // A linearly implicit step is one factorisation.
  result.has_tolerance = integrator != shell::Integrator::linearly_implicit;
  result.solve         = [=](const int n_steps, const double solver_tolerance, MPI_Comm)
  {
    const double rate        = M_PI / turn; // of (1 − cos(rate t)) / 2, at rest at the beginning
    const SheetMotion motion = [=](const Eigen::RowVector2d &point, const double time)
    { return bulging(point, 0.5 * full_height * (1. - std::cos(rate * time))); };
    const GradedSheet sheet      = sheet_of(6, stiffness);
    const Eigen::VectorXd masses = sheet.masses();
    const Eigen::VectorXd areas  = meshes::signed_areas(sheet.rest);
    const auto forces            = [&](const double time)
    {
      // x is linear in the height: its part that moves is what one more of it adds.
      const double acceleration   = 0.5 * full_height * rate * rate * std::cos(rate * time);
      const meshes::SpacePoints x = positions_of(sheet.rest, at_time(motion, time));
      meshes::SpacePoints f(x.rows(), 3);
      for (int v = 0; v < sheet.rest.n_vertices(); ++v)
      {
        const Eigen::RowVector2d point = sheet.rest.vertices.row(v);
        f.row(v)                       = masses(v) * acceleration *
                   (bulging(point, 1.).value - bulging(point, 0.).value).transpose();
      }
      for (int t = 0; t < sheet.rest.n_triangles(); ++t)
      {
        const Eigen::Matrix<double, 3, 2> gradients = shape_gradients(sheet.rest, t);
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k)
          corners.row(k) = x.row(sheet.rest.triangles(t, k));
        const auto P = energy_and_stress(Law::biot, sheet.stiffness[static_cast<std::size_t>(t)],
                                         corners.transpose() * gradients)
                         .stress;
        for (int k = 0; k < 3; ++k)
          f.row(sheet.rest.triangles(t, k)) += areas(t) * gradients.row(k) * P.transpose();
      }
      return f;
    };
    FollowingCloth cloth(sheet, motion, cloth_options(integrator, solver_tolerance), forces);
    cloth.take_steps(n_steps, end / n_steps);
    return cloth.compared_at_vertices(motion);
  };
  return result;
}
} // namespace

std::vector<ManufacturedCase> shell_cases()
{
  std::vector<ManufacturedCase> cases;
  for (const Law law : {Law::linear, Law::biot})
    for (const NamedStiffness &stiffness :
         {uniform(without_contraction()), graded(without_contraction())})
      cases.push_back(plane_case(law, stiffness));
  for (const NamedStiffness &stiffness : {uniform(anisotropic()), graded(anisotropic())})
  {
    cases.push_back(static_case(stiffness));
    cases.push_back(stepping_case(stiffness));
  }
  cases.push_back(time_case("linearly implicit Euler", shell::Integrator::linearly_implicit, 1.));
  cases.push_back(time_case("implicit Euler", shell::Integrator::implicit, 1.));
  cases.push_back(time_case("conserving integrator", shell::Integrator::conserving, 2.));
  return cases;
}
} // namespace homespun::verification
