// SPDX-License-Identifier: MIT
// The cloth of shell/ against motions that it must reproduce: its equilibria in the plane and in
// space, steps in time on finer and finer meshes, and finer and finer steps on one mesh.
#include "meshes/plain/errors.h"
#include "shell/solver/cloth.h"
#include "shell/solver/equilibrium.h"
#include "shell/terms/external_term.h"
#include "shell/terms/membrane_term.h"
#include "verification/converge/manufactured.h"
#include "verification/converge/manufactured_cases.h"
#include "verification/converge/nodal_fields.h"
#include "verification/record/number_text.h"

#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr double side             = manufactured_side;
constexpr double density          = 0.2; ///< [kg/m^2]
const std::vector<int> mesh_sizes = {6, 12, 24, 48};

/// A stiffness that is one, or varies smoothly.
struct Stiffness
{
  std::string name;
  StiffnessField at;
};

Stiffness uniform(const Eigen::Matrix3d &stiffness)
{
  return {"homogeneous", [=](const Eigen::RowVector2d &) { return stiffness; }};
}

Stiffness graded(const Eigen::Matrix3d &stiffness)
{
  return {"heterogeneous",
          [=](const Eigen::RowVector2d &point) { return varied(stiffness, point); }};
}

/// An irregular mesh whose triangles are phases of their own, with the stiffness of their centres.
struct Sheet
{
  meshes::TriangleMesh rest;
  std::vector<Eigen::Matrix3d> stiffness;
  std::vector<int> rim;
};

Sheet sheet_of(const int n, const Stiffness &stiffness)
{
  Sheet sheet;
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
        point.minCoeff() < 1e-9 * side || point.maxCoeff() > (1. - 1e-9) * side)
      sheet.rim.push_back(v);
  return sheet;
}

/// −Div P per rest area.
FieldValue elastic_force(const Law law, const StiffnessField &stiffness, const KnownField &motion,
                         const Eigen::RowVector2d &point)
{
  return equilibrium_force(law, stiffness, motion.gradient, point, manufactured_difference);
}

meshes::SpacePoints positions_of(const meshes::TriangleMesh &rest, const KnownField &motion)
{
  meshes::SpacePoints positions(rest.n_vertices(), 3);
  for (int v = 0; v < rest.n_vertices(); ++v)
    positions.row(v) = motion.value(rest.vertices.row(v)).transpose();
  return positions;
}

/// A strip that is stretched by 10 % along axis 2, clamped at both ends, free at its sides.
ManufacturedCase plane_case(const Law law, const Stiffness &stiffness)
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
    const Sheet sheet = sheet_of(n, stiffness);
    const meshes::Points loads =
      nodal_loads(sheet.rest, [&](const Eigen::RowVector2d &point)
                  { return elastic_force(law, stiffness.at, motion, point); })
        .leftCols<2>();
    std::vector<int> clamped;
    shell::Positions<2> start = sheet.rest.vertices;
    for (const int v : sheet.rim)
      if (const double y = sheet.rest.vertices(v, 1) / side; std::abs(y - 0.5) > 0.5 - 1e-9)
      {
        clamped.push_back(v);
        start(v, 1) *= 1. + strain;
      }
    const shell::MembraneSolver<2> solver(sheet.rest, sheet.stiffness, clamped);
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

/// A motion through time.
using Motion = std::function<Wave(const Eigen::RowVector2d &point, double time)>;

KnownField at_time(const Motion &motion, const double time)
{
  return {[=](const Eigen::RowVector2d &point) { return motion(point, time).value; },
          [=](const Eigen::RowVector2d &point) { return motion(point, time).gradient; }};
}

/// A cloth that begins where a motion does, at rest, with the forces that make it follow.
class FollowingCloth
{
public:
  FollowingCloth(const Sheet &sheet, const Motion &motion, const shell::ClothOptions &options,
                 std::function<meshes::SpacePoints(double time)> forces)
      : sheet(sheet)
      , motion(motion)
      , cloth(start_of(sheet, motion), masses_of(sheet), sheet.rim, options)
  {
    cloth.add(shell::membrane_term(mesh_of(sheet, motion), sheet.stiffness));
    cloth.add(std::make_unique<GivenForces>(
      std::move(forces), options.integrator == shell::Integrator::conserving ? 0.5 : 1.));
  }

  static Eigen::VectorXd masses_of(const Sheet &sheet)
  {
    const std::vector<double> densities(sheet.stiffness.size(), density);
    return shell::lumped_masses(meshes::placed_sheet(sheet.rest,
                                                     Eigen::Matrix<double, 3, 2>::Identity(),
                                                     Eigen::RowVector3d::Zero()),
                                densities);
  }

  /// @throws NotConverged where a step is cut: then it is not the scheme that was asked for
  void take_steps(const int n_steps, const double dt)
  {
    for (int k = 1; k <= n_steps; ++k)
    {
      hold_at(k * dt);
      if (const shell::StepReport report = cloth.step(dt); report.cuts != 0)
        throw meshes::NotConverged("a step of " + short_text(dt) + " s was cut", {});
    }
  }

  void find_equilibrium(const double tolerance)
  {
    hold_at(0.);
    cloth.solve_equilibrium(tolerance);
  }

  /// Against the motion at the time of the cloth, over the area.
  ManufacturedSolution compared(const Motion &exact) const
  {
    const meshes::SpacePoints found = cloth.positions();
    return {distance(sheet.rest, found, at_time(exact, cloth.time())),
            static_cast<unsigned long>(found.size()), found};
  }

  /// The same over the vertices.
  ManufacturedSolution compared_at_vertices(const Motion &exact) const
  {
    const meshes::SpacePoints found = cloth.positions();
    const meshes::SpacePoints known = positions_of(sheet.rest, at_time(exact, cloth.time()));
    const double mean =
      std::sqrt((found - known).squaredNorm() / static_cast<double>(found.rows()));
    return {{side * mean, 0.}, static_cast<unsigned long>(found.size()), found};
  }

private:
  static meshes::SpacePoints start_of(const Sheet &sheet, const Motion &motion)
  {
    return positions_of(sheet.rest, at_time(motion, 0.));
  }
  static meshes::ClothMesh mesh_of(const Sheet &sheet, const Motion &motion)
  {
    return {sheet.rest, start_of(sheet, motion), sheet.rest.triangles};
  }
  void hold_at(const double time)
  {
    for (const int v : sheet.rim)
      cloth.prescribe(v, motion(sheet.rest.vertices.row(v), time).value.transpose());
  }

  const Sheet &sheet;
  const Motion motion;
  shell::Cloth cloth;
};

shell::ClothOptions cloth_options(const shell::Integrator integrator, const double tolerance)
{
  shell::ClothOptions options;
  options.integrator       = integrator;
  options.newton_tolerance = tolerance;
  return options;
}

ManufacturedCase static_case(const Stiffness &stiffness)
{
  ManufacturedCase result =
    of_elements("shell in space; statics; " + stiffness.name + "; biot", 1, mesh_sizes);
  result.solve = [=](const int n, const double solver_tolerance, MPI_Comm)
  {
    const Sheet sheet = sheet_of(n, stiffness);
    // The start is half as high as what is to be found.
    const Motion start = [](const Eigen::RowVector2d &point, double)
    { return bulging(point, 0.5 * full_height); };
    const Motion exact = [](const Eigen::RowVector2d &point, double)
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
ManufacturedCase stepping_case(const Stiffness &stiffness)
{
  ManufacturedCase result =
    of_elements("shell in space; steps; " + stiffness.name + "; biot", 1, mesh_sizes);
  result.solve = [=](const int n, const double solver_tolerance, MPI_Comm)
  {
    constexpr double dt   = 2e-3;
    constexpr int n_steps = 4;
    const Motion motion   = [](const Eigen::RowVector2d &point, const double time)
    {
      const double part = std::max(0., time) / (n_steps * dt);
      return bulging(point, full_height * part * part);
    };
    const Sheet sheet = sheet_of(n, stiffness);
    const auto force  = [&](const Eigen::RowVector2d &point, const double time) -> FieldValue
    {
      const FieldValue acceleration =
        (motion(point, time).value - 2. * motion(point, time - dt).value +
         motion(point, time - 2. * dt).value) /
        (dt * dt);
      return density * acceleration +
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
  const Stiffness stiffness = graded(anisotropic());
  ManufacturedCase result =
    of_time_steps("shell in space; " + name + " in time; " + stiffness.name + "; biot", order,
                  {16, 32, 64, 128, 256}, end);
  // A linearly implicit step is one factorisation.
  result.has_tolerance = integrator != shell::Integrator::linearly_implicit;
  result.solve         = [=](const int n_steps, const double solver_tolerance, MPI_Comm)
  {
    const double rate   = M_PI / turn; // of (1 − cos(rate t)) / 2, at rest at the beginning
    const Motion motion = [=](const Eigen::RowVector2d &point, const double time)
    { return bulging(point, 0.5 * full_height * (1. - std::cos(rate * time))); };
    const Sheet sheet            = sheet_of(6, stiffness);
    const Eigen::VectorXd masses = FollowingCloth::masses_of(sheet);
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
    for (const Stiffness &stiffness :
         {uniform(without_contraction()), graded(without_contraction())})
      cases.push_back(plane_case(law, stiffness));
  for (const Stiffness &stiffness : {uniform(anisotropic()), graded(anisotropic())})
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
