// SPDX-License-Identifier: MIT
#include "tests/verification/manufactured/manufactured_cases.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "tests/verification/manufactured/manufactured.h"
#include "tests/verification/manufactured/manufactured_motions.h"
#include "verification/record/fields.h"
#include "verification/record/number_text.h"
#include "verification/reference/cloth_reference.h"
#include "verification/reference/fine_reference.h"

#include <array>
#include <cmath>
#include <map>
#include <memory>

namespace homespun::verification
{
namespace
{
constexpr double density = 0.2; ///< [kg/m^2]

constexpr int n_coarsest = 4; ///< divisions of a side before meshes are refined

std::vector<int> sizes_of(const unsigned int order)
{
  return order == 1 ? std::vector<int>{8, 16, 32, 64} : std::vector<int>{4, 8, 16, 32};
}

/// Forces at points and times that Newton's method asks for again and again: each is found once.
using KnownForces = std::map<std::array<double, 3>, Eigen::RowVector3d>;

template <typename Force>
Eigen::RowVector3d known_force(KnownForces &known, const Eigen::RowVector2d &point,
                               const double time, const Force &force)
{
  const auto [place, is_new] = known.try_emplace({point(0), point(1), time});
  if (is_new)
    place->second = force(point, time);
  return place->second;
}

/// FineReference at a strain of 10 %, whose exact solution is the load's affine motion + `wave`.
ManufacturedCase plane_case(const std::string &load_name, const Law law, const unsigned int order,
                            const Eigen::Matrix3d &stiffness, const PlaneField wave)
{
  ManufacturedCase result =
    of_elements("sheet in the plane; " + load_name + "; " + name_of(law), order, sizes_of(order));
  const auto known = std::make_shared<KnownForces>();
  result.solve     = [=](const int n, const double solver_tolerance, const MPI_Comm communicator)
  {
    constexpr double strain = 0.1;
    const Load load(load_name);
    meshes::Lattice lattice;
    lattice.vectors           = manufactured_side * Eigen::Matrix2d::Identity();
    const meshes::Sheet sheet = meshes::tile(irregular_mesh(n, n_coarsest), lattice, 1, 1);
    const auto affine         = [&](const double s) -> Eigen::Matrix2d
    {
      if (load.is_periodic())
        return load.gradient(s);
      return Eigen::Vector2d(1., 1. + s).asDiagonal(); // strip-2
    };
    const auto found_force = [&](const Eigen::RowVector2d &point, const double s)
    {
      return equilibrium_force(
        law, stiffness,
        [&](const Eigen::RowVector2d &at)
        {
          FieldGradient F = wave(at, s).gradient;
          F.topRows<2>() += affine(s);
          return F;
        },
        point, manufactured_difference);
    };
    const FineReference::BodyForce force = [&](const Eigen::RowVector2d &point,
                                               const double s) -> Eigen::RowVector2d
    { return known_force(*known, point, s, found_force).head<2>(); };
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

ClothReference::Held rim_of(const SheetMotion &motion)
{
  return [motion](const Eigen::RowVector2d &point,
                  const double time) -> std::optional<Eigen::RowVector3d>
  {
    if (point.minCoeff() < 1e-9 * manufactured_side ||
        point.maxCoeff() > (1. - 1e-9) * manufactured_side)
      return Eigen::RowVector3d(motion(point, time).value.transpose());
    return std::nullopt;
  };
}

ClothReference::Placement start_of(const SheetMotion &motion)
{
  return [motion](const Eigen::RowVector2d &point)
  { return Eigen::RowVector3d(motion(point, 0.).value.transpose()); };
}

/// −Div P of a sheet in space.
Eigen::RowVector3d elastic_force(const Law law, const SheetMotion &motion, const double time,
                                 const Eigen::RowVector2d &point)
{
  return equilibrium_force(
           law, anisotropic(),
           [&](const Eigen::RowVector2d &at) { return motion(at, time).gradient; }, point,
           manufactured_difference)
    .transpose();
}

ManufacturedCase space_case(const std::string &what, const Law law, const unsigned int order)
{
  return of_elements("cloth in space; " + what + "; " + name_of(law), order, sizes_of(order));
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
  return ClothReference(irregular_mesh(n, n_coarsest), {anisotropic()}, {density}, options,
                        communicator);
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
  const auto known        = std::make_shared<KnownForces>();
  result.solve = [=](const int n, const double solver_tolerance, const MPI_Comm communicator)
  {
    // The start is half as high as what is to be found.
    const SheetMotion start = [](const Eigen::RowVector2d &point, double)
    { return bulging(point, 0.5 * full_height); };
    const SheetMotion exact = [](const Eigen::RowVector2d &point, double)
    { return bulging(point, full_height); };
    ClothLoads loads;
    loads.body_force = [&](const Eigen::RowVector2d &point, double)
    {
      return known_force(*known, point, 0.,
                         [&](const Eigen::RowVector2d &at, const double time)
                         { return elastic_force(law, exact, time, at); });
    };
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

/// Two steps of implicit Euler on a motion whose force contains the scheme's own difference
/// quotient,
///   f_n = rho (x_n − 2 x_(n−1) + x_(n−2)) / h² − Div P(x_n),   x_(−1) = x_0,
/// so that the steps are exact and what remains is the error of the elements.
ManufacturedCase stepping_case(const Law law, const unsigned int order, const bool consistent)
{
  ManufacturedCase result = space_case(
    std::string("steps with ") + (consistent ? "consistent" : "lumped") + " mass", law, order);
  const auto known = std::make_shared<KnownForces>();
  result.solve     = [=](const int n, const double solver_tolerance, const MPI_Comm communicator)
  {
    constexpr double dt      = 2e-3;
    constexpr int n_steps    = 2; // the second with a velocity
    const SheetMotion motion = [](const Eigen::RowVector2d &point, const double time)
    {
      const double part = std::max(0., time) / (n_steps * dt);
      return bulging(point, full_height * part * part);
    };
    ClothLoads loads;
    const auto found_force = [&](const Eigen::RowVector2d &point, const double time)
    {
      const FieldValue acceleration =
        (motion(point, time).value - 2. * motion(point, time - dt).value +
         motion(point, time - 2. * dt).value) /
        (dt * dt);
      return Eigen::RowVector3d(density * acceleration.transpose() +
                                elastic_force(law, motion, time, point));
    };
    loads.body_force = [&](const Eigen::RowVector2d &point, const double time)
    { return known_force(*known, point, time, found_force); };
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
  ManufacturedCase result = of_time_steps("cloth in space; implicit Euler in time; " + name_of(law),
                                          1., {16, 32, 64, 128, 256}, end);
  result.solve = [=](const int n_steps, const double solver_tolerance, const MPI_Comm communicator)
  {
    FieldGradient change; // of F, at its largest
    change << 0.2, 0.05, 0., 0.1, 0.6, -0.3;
    const double rate = M_PI / turn; // of a = (1 − cos(rate t)) / 2, at rest at the beginning
    const SheetMotion motion = [=](const Eigen::RowVector2d &point, const double time)
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
    ClothReference cloth =
      cloth_reference(n_coarsest, law, 1, true, solver_tolerance, communicator);
    cloth.start(start_of(motion), rim_of(motion), loads);
    take_steps(cloth, n_steps, end / n_steps);
    return ManufacturedSolution{cloth.distance_from(at_time(motion, end)), cloth.n_dofs(),
                                cloth.positions()};
  };
  return result;
}
} // namespace

std::vector<ManufacturedCase> reference_cases()
{
  std::vector<ManufacturedCase> cases;
  for (const unsigned int order : {1u, 2u})
    for (const Law law : all_laws())
    {
      cases.push_back(plane_case("periodic-12", law, order, anisotropic(), periodic_wave));
      cases.push_back(plane_case("strip-2", law, order, without_contraction(), clamped_wave));
    }
  for (const unsigned int order : {1u, 2u})
    for (const Law law : {Law::biot, Law::green, Law::yarn})
    {
      cases.push_back(static_case(law, order));
      cases.push_back(stepping_case(law, order, true));
      if (order == 1)
        cases.push_back(stepping_case(law, order, false));
    }
  for (const Law law : {Law::biot, Law::green, Law::yarn})
    cases.push_back(time_case(law));
  return cases;
}
} // namespace homespun::verification
