// SPDX-License-Identifier: MIT
// The cell problems with a force in the cell that makes chi a known periodic field: one stiffness,
// two layers with a kink between them, a stiffness that varies smoothly.
//
// With the total stress sigma_a = c : (eps(chi_a) − e_a) the force is f_a = −div sigma_a. Between
// layers sigma n is continuous: there chi has the kink that a linear system of each point of the
// interface asks for. A stiffness per triangle stands for a smooth one with order 2, so that only
// P1 is tried on that: with P2 theory has order 2 in L2 and 1 in H1 too.
#include "homogenization/fem/cell_forces.h"
#include "homogenization/fem/homogenize.h"
#include "meshes/cloth/irregular_sheet.h"
#include "meshes/plain/refine.h"
#include "tests/verification/manufactured/manufactured.h"
#include "tests/verification/manufactured/manufactured_cases.h"
#include "verification/reference/field_integrals.h"

#include <Eigen/LU>

#include <array>
#include <cmath>

namespace homespun::verification
{
namespace
{
using homogenization::Phase;
using homogenization::UnitCell;

/// Orthotropic: chi feels every entry of c.
Phase phase_of(const double E1, const double E2, const double angle)
{
  Phase phase;
  phase.name      = "phase";
  phase.E1        = E1;
  phase.E2        = E2;
  phase.nu12      = 0.3;
  phase.G12       = 0.4 * E2;
  phase.angle     = angle;
  phase.thickness = 5e-4;
  phase.density   = 400.;
  return phase;
}

/// How the stiffness varies over the cell.
enum class Variation
{
  none,
  layers,
  smooth
};

struct Material
{
  std::string name;
  Variation variation;
  Phase (*phase_at)(const Eigen::RowVector2d &point);

  bool has_kinks_at(const Eigen::RowVector2d &point) const
  {
    return variation == Variation::layers && point(1) > 0.5 * manufactured_side;
  }
};

Phase everywhere(const Eigen::RowVector2d &)
{
  return phase_of(3e6, 1e6, 25.);
}

Phase layers(const Eigen::RowVector2d &point)
{
  return point(1) > 0.5 * manufactured_side ? phase_of(4e6, 2e6, -20.) : phase_of(3e6, 1e6, 25.);
}

Phase smooth(const Eigen::RowVector2d &point)
{
  const double k = 2. * M_PI / manufactured_side, x = k * point(0), y = k * point(1);
  return phase_of(3e6 * (1. + 0.4 * std::sin(x + 0.3) * std::cos(y)),
                  1e6 * (1. + 0.5 * std::cos(x) * std::sin(y + 1.)), 25. + 15. * std::sin(x - y));
}

/// The tensor of the unit strain e_a, with engineering shear.
Eigen::Matrix2d unit_strain(const int a)
{
  Eigen::Matrix2d e = Eigen::Matrix2d::Zero();
  if (a < 2)
    e(a, a) = 1.;
  else
    e(0, 1) = e(1, 0) = 0.5;
  return e;
}

/// chi without kinks: the same wave of each load at another place of the cell.
Wave wave_of(const int a, const Eigen::RowVector2d &point)
{
  const Eigen::RowVector2d shift(0.13 * a * manufactured_side, 0.31 * a * manufactured_side);
  return periodic_wave(point + shift, 1.);
}

/// Between the layers at y the slope of chi along axis 2 is larger above than below by
///   A^-1 (t_below − t_above),   t = (sigma_12, sigma_22) of the wave,   A a = t of a (x) n above,
/// so that tractions are continuous.
Eigen::Vector2d jump_of_slope(const int a, const double x, const double y)
{
  const Eigen::Matrix2d gradient = wave_of(a, {x, y}).gradient.topRows<2>() - unit_strain(a);
  const Eigen::Vector3d strain(gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0));
  const Eigen::Matrix3d below   = plane_stress_stiffness(layers({x, 0.25 * manufactured_side})),
                        above   = plane_stress_stiffness(layers({x, 0.75 * manufactured_side}));
  const Eigen::Vector3d missing = (below - above) * strain;
  Eigen::Matrix2d A;
  A << above(2, 2), above(1, 2), above(1, 2), above(1, 1);
  return A.inverse() * Eigen::Vector2d(missing(2), missing(1));
}

/// The same along an interface: as the wave, it is mean + cosine cos(k x) + sine sin(k x).
struct Kink
{
  Eigen::Vector2d mean, cosine, sine;
};

Kink kink_of(const int a, const double y)
{
  const Eigen::Vector2d at_0    = jump_of_slope(a, 0., y),
                        at_half = jump_of_slope(a, 0.5 * manufactured_side, y);
  Kink kink;
  kink.mean   = 0.5 * (at_0 + at_half);
  kink.cosine = 0.5 * (at_0 - at_half);
  kink.sine   = jump_of_slope(a, 0.25 * manufactured_side, y) - kink.mean;
  return kink;
}

/// The kinks of a load in the middle of the cell and at its top.
const std::array<Kink, 2> &kinks_of(const int a)
{
  static const std::array<std::array<Kink, 2>, 3> all = []()
  {
    std::array<std::array<Kink, 2>, 3> kinks;
    for (int load = 0; load < 3; ++load)
      for (int i = 0; i < 2; ++i)
        kinks[static_cast<std::size_t>(load)][static_cast<std::size_t>(i)] =
          kink_of(load, 0.5 * manufactured_side * (1 + i));
    return kinks;
  }();
  return all[static_cast<std::size_t>(a)];
}

/// Adds what chi has above the middle of the cell, of layers.
void add_kinks(const int a, const Eigen::RowVector2d &point, Wave &chi)
{
  // Cubics of Hermite: one with the slope 1 at the middle of the cell, one at its top.
  constexpr double height = 0.5 * manufactured_side, k = 2. * M_PI / manufactured_side;
  const double s = point(1) / height - 1., c = std::cos(k * point(0)), sn = std::sin(k * point(0));
  const double profiles[2] = {height * s * (1. - s) * (1. - s), height * s * s * (s - 1.)},
               slopes[2]   = {(1. - s) * (1. - 3. * s), s * (3. * s - 2.)};
  for (std::size_t i = 0; i < 2; ++i)
  {
    const Kink &kink           = kinks_of(a)[i];
    const Eigen::Vector2d size = kink.mean + c * kink.cosine + sn * kink.sine;
    chi.value.head<2>() += profiles[i] * size;
    chi.gradient.topRows<2>().col(0) += profiles[i] * k * (c * kink.sine - sn * kink.cosine);
    chi.gradient.topRows<2>().col(1) += slopes[i] * size;
  }
}

/// chi of a load at a point of the layer in which `place` lies.
Wave chi_of(const int a, const Material &material, const Eigen::RowVector2d &point,
            const Eigen::RowVector2d &place)
{
  Wave chi = wave_of(a, point);
  if (material.has_kinks_at(place))
    add_kinks(a, point, chi);
  return chi;
}

/// @param n_coarsest divisions of a side before the mesh is refined to n
UnitCell cell_of(const int n, const int n_coarsest, const Material &material)
{
  meshes::TriangleMesh coarse = meshes::irregular_sheet(n_coarsest, manufactured_side);
  // The middle row lies on the interface.
  for (int v = 0; v < coarse.n_vertices(); ++v)
    if (const double y = coarse.vertices(v, 1) / manufactured_side;
        std::abs(y - 0.5) < 0.3 / n_coarsest)
      coarse.vertices(v, 1) = 0.5 * manufactured_side;
  int refinements = 0;
  while (n_coarsest << refinements < n)
    ++refinements;
  UnitCell cell;
  cell.name            = "manufactured";
  cell.mesh            = meshes::refined(coarse, refinements);
  cell.lattice.vectors = manufactured_side * Eigen::Matrix2d::Identity();
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      centre += cell.mesh.vertices.row(cell.mesh.triangles(t, k)) / 3.;
    cell.phases.push_back(material.phase_at(centre));
    cell.mesh.material(t) = t;
  }
  return cell;
}

/// f_a at a point.
FieldValue force_of(const int a, const Material &material, const Eigen::RowVector2d &point)
{
  const Eigen::Matrix3d here     = plane_stress_stiffness(material.phase_at(point));
  const StiffnessField stiffness = [&](const Eigen::RowVector2d &at) -> Eigen::Matrix3d
  {
    return material.variation == Variation::smooth ? plane_stress_stiffness(material.phase_at(at))
                                                   : here;
  };
  return equilibrium_force(
    Law::linear, stiffness,
    [&](const Eigen::RowVector2d &at)
    {
      FieldGradient F = chi_of(a, material, at, point).gradient;
      F.topRows<2>() += Eigen::Matrix2d::Identity() - unit_strain(a);
      return F;
    },
    point, manufactured_difference);
}

ManufacturedCase cell_case(const Material &material, const unsigned int order,
                           const std::vector<int> &sizes)
{
  ManufacturedCase result = of_elements("homogenizer; " + material.name + "; linear", order, sizes);
  result.solve = [=](const int n, const double solver_tolerance, const MPI_Comm communicator)
  {
    homogenization::HomogenizationOptions options;
    options.order     = order;
    options.tolerance = solver_tolerance;
    options.solver    = homogenization::CellSolver::multigrid; // which has a tolerance
    ManufacturedSolution solution;
    homogenization::CellForces forces;
    forces.load_vector = [&](const int a, const auto &discretization, const auto &constraints)
    {
      return load_vector(discretization, constraints,
                         [&](const Eigen::RowVector2d &point)
                         { return force_of(a, material, point); });
    };
    forces.look = [&](const int a, const auto &discretization, const auto &chi)
    {
      const auto at = [&](const Eigen::RowVector2d &point)
      { return chi_of(a, material, point, point); };
      const FieldDistance one =
        distance(discretization, chi,
                 {[&](const Eigen::RowVector2d &point) { return at(point).value; },
                  [&](const Eigen::RowVector2d &point) { return at(point).gradient; }},
                 true);
      solution.error.L2 = std::hypot(solution.error.L2, one.L2);
      solution.error.H1 = std::hypot(solution.error.H1, one.H1);
      solution.n_dofs   = discretization.n_dofs();
    };
    solution.positions =
      chi_under_forces(cell_of(n, sizes.front(), material), options, forces, communicator);
    return solution;
  };
  return result;
}
} // namespace

std::vector<ManufacturedCase> homogenizer_cases()
{
  const Material one    = {"homogeneous", Variation::none, everywhere};
  const Material two    = {"layers", Variation::layers, layers};
  const Material graded = {"heterogeneous", Variation::smooth, smooth};
  return {cell_case(one, 1, {6, 12, 24, 48}), cell_case(two, 1, {8, 16, 32, 64}),
          cell_case(graded, 1, {6, 12, 24, 48}), cell_case(one, 2, {4, 8, 16, 32}),
          cell_case(two, 2, {4, 8, 16, 32})};
}
} // namespace homespun::verification
