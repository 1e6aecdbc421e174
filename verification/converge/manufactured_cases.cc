// SPDX-License-Identifier: MIT
#include "verification/converge/manufactured_cases.h"

#include "meshes/cloth/irregular_sheet.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"
#include "meshes/plain/sheet.h"
#include "verification/converge/manufactured.h"
#include "verification/record/fields.h"
#include "verification/record/number_text.h"
#include "verification/reference/cloth_reference.h"
#include "verification/reference/fine_reference.h"

#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr double side            = manufactured_side;
constexpr double density         = 0.2; ///< [kg/m^2]
constexpr double difference_step = 2e-3 * side;

/// A case whose levels are mesh widths, with the orders of its elements.
ManufacturedCase of_elements(const std::string &name, const unsigned int order)
{
  ManufacturedCase result;
  result.name   = name;
  result.order  = order;
  result.h_unit = "side";
  result.sizes  = order == 1 ? std::vector<int>{12, 24, 48, 96} : std::vector<int>{6, 12, 24, 48};
  result.extent = 1.;
  result.L2     = about(order + 1.);
  result.H1     = about(order);
  return result;
}

Eigen::Matrix3d anisotropic()
{
  Eigen::Matrix3d C;
  C << 1500., 330., 120., 330., 600., -90., 120., -90., 270.;
  return C;
}

/// Without contraction: a sheet stretched along axis 2 has no forces on its sides.
Eigen::Matrix3d without_contraction()
{
  return Eigen::Vector3d(1500., 600., 270.).asDiagonal();
}

/// An irregular mesh, always the same one, refined until there are n divisions along a side: were
/// it drawn anew on each level, chance would blur the orders.
meshes::TriangleMesh irregular_mesh(const int n)
{
  constexpr int n_coarsest = 6;
  int refinements          = 0;
  while (n_coarsest << refinements < n)
    ++refinements;
  return meshes::refined(meshes::irregular_sheet(n_coarsest, side), refinements);
}

/// A field with its derivatives by the rest point.
struct Wave
{
  FieldValue value;
  FieldGradient gradient;
};

/// A displacement in the plane, in proportion to the strain.
using PlaneField = Wave (*)(const Eigen::RowVector2d &point, double strain);

/// Periodic with the sheet, of no symmetry; strains of up to 0.7 times `strain` beside the mean
/// one.
Wave periodic_wave(const Eigen::RowVector2d &point, const double strain)
{
  const double k = 2. * M_PI / side, x = k * point(0), y = k * point(1);
  const double size = 0.08 * strain * side;
  Wave wave;
  wave.value << std::sin(x + 0.4) * std::cos(y) + 0.3 * std::sin(y - 1.),
    std::cos(x - 0.9) * std::sin(y + 0.3) - 0.4 * std::cos(x), 0.;
  wave.gradient << std::cos(x + 0.4) * std::cos(y),
    -std::sin(x + 0.4) * std::sin(y) + 0.3 * std::cos(y - 1.),
    -std::sin(x - 0.9) * std::sin(y + 0.3) + 0.4 * std::sin(x),
    std::cos(x - 0.9) * std::cos(y + 0.3), 0., 0.;
  return {size * wave.value, size * k * wave.gradient};
}

/// Zero where the sheet is clamped; zero with its derivatives on the free sides.
Wave clamped_wave(const Eigen::RowVector2d &point, const double strain)
{
  const double x = point(0) / side, y = point(1) / side;
  const double bump  = 16. * x * x * (1. - x) * (1. - x);
  const double slope = 32. * x * (1. - x) * (1. - 2. * x);
  const double s1 = std::sin(M_PI * y), c1 = M_PI * std::cos(M_PI * y);
  const double s2 = std::sin(2. * M_PI * y), c2 = 2. * M_PI * std::cos(2. * M_PI * y);
  const double size = 0.15 * strain * side;
  Wave wave;
  wave.value << bump * s2, bump * (1. + x) * s1, 0.;
  wave.gradient << slope * s2, bump * c2, (slope * (1. + x) + bump) * s1, bump * (1. + x) * c1, 0.,
    0.;
  return {size * wave.value, size / side * wave.gradient};
}

/// FineReference at a strain of 10 %, whose exact solution is the load's affine motion + `wave`.
ManufacturedCase plane_case(const std::string &load_name, const Law law, const unsigned int order,
                            const Eigen::Matrix3d &stiffness, const PlaneField wave)
{
  ManufacturedCase result =
    of_elements("sheet in the plane; " + load_name + "; " + name_of(law), order);
  result.solve = [=](const int n, const double solver_tolerance, const MPI_Comm communicator)
  {
    constexpr double strain = 0.1;
    const Load load(load_name);
    meshes::Lattice lattice;
    lattice.vectors           = side * Eigen::Matrix2d::Identity();
    const meshes::Sheet sheet = meshes::tile(irregular_mesh(n), lattice, 1, 1);
    const auto affine         = [&](const double s) -> Eigen::Matrix2d
    {
      if (load.is_periodic())
        return load.gradient(s);
      return Eigen::Vector2d(1., 1. + s).asDiagonal(); // strip-2
    };
    const FineReference::BodyForce force = [&](const Eigen::RowVector2d &point, const double s)
    {
      const Eigen::Vector3d f = equilibrium_force(
        law, stiffness,
        [&](const Eigen::RowVector2d &at)
        {
          FieldGradient F = wave(at, s).gradient;
          F.topRows<2>() += affine(s);
          return F;
        },
        point, difference_step);
      return Eigen::RowVector2d(f(0), f(1));
    };
    ReferenceOptions options;
    options.order     = order;
    options.tolerance = solver_tolerance;
    FineReference reference(sheet, {stiffness}, options, communicator);
    reference.start(load, law, force);
    const ReferenceStep step = reference.advance(strain);
    if (!step.reached)
      throw meshes::NotConverged(step.why, {});
    // The unknowns of periodic loads are the fluctuation alone.
    Eigen::Matrix2d beside = Eigen::Matrix2d::Zero();
    if (!load.is_periodic())
      beside = affine(strain) - Eigen::Matrix2d::Identity();
    KnownField exact;
    exact.value = [&](const Eigen::RowVector2d &point)
    {
      FieldValue value = wave(point, strain).value;
      value.head<2>() += beside * point.transpose();
      return value;
    };
    exact.gradient = [&](const Eigen::RowVector2d &point)
    {
      FieldGradient gradient = wave(point, strain).gradient;
      gradient.topRows<2>() += beside;
      return gradient;
    };
    return ManufacturedSolution{reference.distance_from(exact), reference.n_dofs(), step.positions};
  };
  return result;
}

/// A sheet in space: stretched in its plane, and a bump of a height with a shift inside the sheet.
/// Its rim stays.
Wave bulging(const Eigen::RowVector2d &point, const double height)
{
  const double x = point(0) / side, y = point(1) / side;
  const double sx = std::sin(M_PI * x), cx = M_PI * std::cos(M_PI * x);
  const double sy = std::sin(M_PI * y), cy = M_PI * std::cos(M_PI * y);
  const double bump = height * sx * sy, bump_x = height * cx * sy, bump_y = height * sx * cy;
  const double c = std::cos(2. * y), lift = 1. + 0.5 * x - 0.3 * y;
  Wave wave;
  wave.value << 1.10 * x + 0.04 * y + 0.3 * bump * c, 1.08 * y + 0.4 * bump * (1. - x), bump * lift;
  wave.gradient << 1.10 + 0.3 * bump_x * c,
    0.04 + 0.3 * (bump_y * c - 2. * bump * std::sin(2. * y)), 0.4 * (bump_x * (1. - x) - bump),
    1.08 + 0.4 * bump_y * (1. - x), bump_x * lift + 0.5 * bump, bump_y * lift - 0.3 * bump;
  return {side * wave.value, wave.gradient};
}

constexpr double full_height = 0.25; ///< of the bump, over the side

/// A motion through time, held at its rim.
using SpaceMotion = std::function<Wave(const Eigen::RowVector2d &point, double time)>;

ClothReference::Held rim_of(const SpaceMotion &motion)
{
  return [motion](const Eigen::RowVector2d &point,
                  const double time) -> std::optional<Eigen::RowVector3d>
  {
    if (point.minCoeff() < 1e-9 * side || point.maxCoeff() > (1. - 1e-9) * side)
      return Eigen::RowVector3d(motion(point, time).value.transpose());
    return std::nullopt;
  };
}

ClothReference::Placement start_of(const SpaceMotion &motion)
{
  return [motion](const Eigen::RowVector2d &point)
  { return Eigen::RowVector3d(motion(point, 0.).value.transpose()); };
}

KnownField at_time(const SpaceMotion &motion, const double time)
{
  return {[=](const Eigen::RowVector2d &point) { return motion(point, time).value; },
          [=](const Eigen::RowVector2d &point) { return motion(point, time).gradient; }};
}

/// −Div P of a sheet in space.
Eigen::RowVector3d elastic_force(const Law law, const SpaceMotion &motion, const double time,
                                 const Eigen::RowVector2d &point)
{
  return equilibrium_force(
           law, anisotropic(),
           [&](const Eigen::RowVector2d &at) { return motion(at, time).gradient; }, point,
           difference_step)
    .transpose();
}

ManufacturedCase space_case(const std::string &what, const Law law, const unsigned int order)
{
  return of_elements("cloth in space; " + what + "; " + name_of(law), order);
}

ClothReference cloth_reference(const int n, const Law law, const unsigned int order,
                               const bool consistent, const double solver_tolerance,
                               const MPI_Comm communicator)
{
  ClothReferenceOptions options;
  options.law             = law;
  options.order           = order;
  options.consistent_mass = consistent;
  options.tolerance       = solver_tolerance;
  return ClothReference(irregular_mesh(n), {anisotropic()}, {density}, options, communicator);
}

/// @throws NotConverged where a step is not reached, or was cut: then it is not the scheme that was
///   asked for
void take_steps(ClothReference &cloth, const int n_steps, const double dt)
{
  for (int k = 0; k < n_steps; ++k)
    if (const ClothStep step = cloth.step(dt); !step.reached || step.n_parts != 1)
      throw meshes::NotConverged("a step of " + short_text(dt) + " s was cut: " + step.why, {});
}

ManufacturedCase static_case(const Law law, const unsigned int order)
{
  ManufacturedCase result = space_case("statics", law, order);
  result.solve = [=](const int n, const double solver_tolerance, const MPI_Comm communicator)
  {
    // The start is half as high as what is to be found.
    const SpaceMotion start = [](const Eigen::RowVector2d &point, double)
    { return bulging(point, 0.5 * full_height); };
    const SpaceMotion exact = [](const Eigen::RowVector2d &point, double)
    { return bulging(point, full_height); };
    ClothLoads loads;
    loads.body_force = [&](const Eigen::RowVector2d &point, double)
    { return elastic_force(law, exact, 0., point); };
    ClothReference cloth = cloth_reference(n, law, order, true, solver_tolerance, communicator);
    cloth.start(start_of(start), rim_of(exact), loads);
    const ClothStep step = cloth.solve_equilibrium(0.);
    if (!step.reached)
      throw meshes::NotConverged(step.why, {});
    return ManufacturedSolution{cloth.distance_from(at_time(exact, 0.)), cloth.n_dofs(),
                                cloth.positions()};
  };
  return result;
}

/// Four steps of implicit Euler on a motion whose force contains the scheme's own difference
/// quotient,
///   f_n = rho (x_n − 2 x_(n−1) + x_(n−2)) / h² − Div P(x_n),   x_(−1) = x_0,
/// so that the steps are exact and what remains is the error of the elements.
ManufacturedCase stepping_case(const Law law, const unsigned int order, const bool consistent)
{
  ManufacturedCase result = space_case(
    std::string("steps with ") + (consistent ? "consistent" : "lumped") + " mass", law, order);
  result.solve = [=](const int n, const double solver_tolerance, const MPI_Comm communicator)
  {
    constexpr double dt      = 2e-3;
    constexpr int n_steps    = 4;
    const SpaceMotion motion = [](const Eigen::RowVector2d &point, const double time)
    {
      const double part = std::max(0., time) / (n_steps * dt);
      return bulging(point, full_height * part * part);
    };
    ClothLoads loads;
    loads.body_force = [&](const Eigen::RowVector2d &point, const double time)
    {
      const FieldValue acceleration =
        (motion(point, time).value - 2. * motion(point, time - dt).value +
         motion(point, time - 2. * dt).value) /
        (dt * dt);
      return Eigen::RowVector3d(density * acceleration.transpose() +
                                elastic_force(law, motion, time, point));
    };
    ClothReference cloth =
      cloth_reference(n, law, order, consistent, solver_tolerance, communicator);
    cloth.start(start_of(motion), rim_of(motion), loads);
    take_steps(cloth, n_steps, dt);
    return ManufacturedSolution{cloth.distance_from(at_time(motion, n_steps * dt)), cloth.n_dofs(),
                                cloth.positions()};
  };
  return result;
}

/// A motion that is affine at any time, which P1 contains: Div P = 0, f = rho x'', and only the
/// time steps err. The sheet is turned out of its plane while it is stretched; its rim follows
/// exactly, its inside lags.
ManufacturedCase time_case(const Law law)
{
  constexpr double turn = 4e-3, end = 2.4e-3; // [s]; the inside lags most in the midst of the turn
  ManufacturedCase result;
  result.name   = "cloth in space; implicit Euler in time; " + name_of(law);
  result.order  = 1;
  result.h_unit = "s";
  result.sizes  = {16, 32, 64, 128, 256};
  result.extent = end;
  result.L2     = about(1.);
  result.has_H1 = false;
  result.solve  = [=](const int n_steps, const double solver_tolerance, const MPI_Comm communicator)
  {
    FieldGradient change; // of F, at its largest
    change << 0.2, 0.05, 0., 0.1, 0.6, -0.3;
    const double rate = M_PI / turn; // of a = (1 − cos(rate t)) / 2, at rest at the beginning
    const SpaceMotion motion = [=](const Eigen::RowVector2d &point, const double time)
    {
      const FieldGradient F =
        FieldGradient::Identity() + 0.5 * (1. - std::cos(rate * time)) * change;
      return Wave{F * point.transpose(), F};
    };
    ClothLoads loads;
    loads.body_force = [=](const Eigen::RowVector2d &point, const double time)
    {
      const double acceleration = 0.5 * rate * rate * std::cos(rate * time);
      return Eigen::RowVector3d(density * acceleration * (change * point.transpose()).transpose());
    };
    ClothReference cloth = cloth_reference(6, law, 1, true, solver_tolerance, communicator);
    cloth.start(start_of(motion), rim_of(motion), loads);
    take_steps(cloth, n_steps, end / n_steps);
    return ManufacturedSolution{cloth.distance_from(at_time(motion, end)), cloth.n_dofs(),
                                cloth.positions()};
  };
  return result;
}
} // namespace

const std::vector<ManufacturedCase> &manufactured_cases()
{
  static const std::vector<ManufacturedCase> all = []()
  {
    std::vector<ManufacturedCase> cases;
    for (const unsigned int order : {1u, 2u})
      for (const Law law : {Law::linear, Law::biot, Law::green})
      {
        cases.push_back(plane_case("periodic-12", law, order, anisotropic(), periodic_wave));
        cases.push_back(plane_case("strip-2", law, order, without_contraction(), clamped_wave));
      }
    for (const unsigned int order : {1u, 2u})
      for (const Law law : {Law::biot, Law::green})
      {
        cases.push_back(static_case(law, order));
        cases.push_back(stepping_case(law, order, true));
        if (order == 1)
          cases.push_back(stepping_case(law, order, false));
      }
    for (const Law law : {Law::biot, Law::green})
      cases.push_back(time_case(law));
    return cases;
  }();
  return all;
}
} // namespace homespun::verification
