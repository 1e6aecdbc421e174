// SPDX-License-Identifier: MIT
// All differences are those of the energy of the worst macro strain, so that the soft directions of
// a cell count as much as its stiff ones.
#include "verification/stress/stress_axes.h"

#include "homogenization/bracket/compatible_strain.h"
#include "homogenization/cell/corners.h"
#include "homogenization/cell/laminate.h"
#include "meshes/plain/epsilon.h"
#include "meshes/plain/errors.h"
#include "verification/cell/energy_order.h"
#include "verification/record/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr double most_of_linear = 1e-6; ///< relative energy

const char *const of_direct_solve = "relative energy of the worst macro strain against a direct "
                                    "solve of the same discrete problem; Voigt and Reuss";
const char *const of_laminate = "relative energy of the worst macro strain against the closed form "
                                "of a laminate; Voigt and Reuss";
const char *const of_itself =
  "relative energy of the worst macro strain against the cell as it was";

std::vector<double> decades(const int first, const int last)
{
  std::vector<double> ladder;
  for (int power = first; power <= last; ++power)
    ladder.push_back(std::pow(10., power));
  return ladder;
}

bool is_laminate(const UnitCell &cell)
{
  return homogenization::corners_of(cell.mesh, cell.lattice, cell.stiffness_of_phase()).empty();
}

Eigen::Matrix3d expected_stiffness(const UnitCell &cell)
{
  if (is_laminate(cell))
    return homogenization::laminate_stiffness(cell.mesh, cell.lattice, cell.stiffness_of_phase());
  const homogenization::TorusMesh torus = homogenization::glued(cell.mesh, cell.lattice);
  return homogenization::CompatibleStrain(torus, cell.stiffness_of_phase(), 1).stiffness;
}

StressAnswer answer(const double error, const homogenization::Homogenization &found)
{
  return {error,
          found.stiffness,
          {},
          *std::max_element(found.iterations.begin(), found.iterations.end()),
          found.n_dofs};
}

/// C^H against theory, and against Voigt and Reuss.
StressAnswer against_theory(const UnitCell &cell)
{
  const homogenization::Homogenization found = solved(cell);
  double worst = larger(energy_difference(found.stiffness, expected_stiffness(cell)),
                        order_violation(found.stiffness, found.voigt));
  if (!found.reuss.isZero()) // as it is where the cell has holes
    worst = larger(worst, order_violation(found.reuss, found.stiffness));
  return answer(worst, found);
}

/// A cell whose C^H must be that of the cell as it was, moved by T and times a factor.
StressAnswer against_itself(const UnitCell &cell, const UnitCell &moved,
                            const Eigen::Matrix3d &T = Eigen::Matrix3d::Identity(),
                            const double factor      = 1.)
{
  const homogenization::Homogenization found = solved(moved);
  const Eigen::Matrix3d before               = solved(cell).stiffness;
  return answer(energy_difference(found.stiffness / factor, T * before * T.transpose()), found);
}

/// Names and criterion of an axis of a cell, with what theory says.
StressAxis named(const UnitCell &cell, const char *const name, const char *const value_is,
                 const char *const criterion, const std::vector<double> &ladder,
                 const TheoryOfEnd theory = TheoryOfEnd::none, const double end = 0.,
                 const std::string &theory_is = {})
{
  StressAxis axis;
  axis.axis       = name;
  axis.of         = cell.name;
  axis.value_is   = value_is;
  axis.criterion  = criterion;
  axis.limit      = most_of_linear;
  axis.ladder     = ladder;
  axis.theory     = theory;
  axis.theory_end = end;
  axis.theory_is  = theory_is;
  return axis;
}

/// What makes the phases of a cell hard.
void add_phases(const UnitCell &cell, std::vector<StressAxis> &axes)
{
  const char *const criterion = is_laminate(cell) ? of_laminate : of_direct_solve;
  const auto add              = [&](StressAxis axis, const std::function<UnitCell(double)> &make)
  {
    axis.at = [=](const double value) { return against_theory(make(value)); };
    axes.push_back(axis);
  };
  const TheoryOfEnd estimates = TheoryOfEnd::estimates;
  const double rows           = std::sqrt(0.5 * cell.mesh.n_triangles());
  // What algebraic_limit() says of a C^H, solved for the contrast and for the anisotropy.
  const double contrast   = std::sqrt(most_of_linear) / (rows * meshes::epsilon),
               anisotropy = most_of_linear / (16. * meshes::epsilon);
  const std::string of_sums =
                      "round-off of the forces of a stiff part that a soft one holds: (rows "
                      "of triangles x 2.2e-16 x contrast)^2 is 1e-6",
                    of_entries = "round-off of the entries of the stiffness of a phase: 16 x "
                                 "2.2e-16 x ratio of its largest to its smallest one is 1e-6";
  if (has_contrast(cell))
  {
    add(named(cell, "contrast", "largest over smallest E of the phases [-]", criterion,
              decades(1, 16), estimates, contrast, of_sums),
        [=](const double value) { return with_contrast(cell, value); });
    add(named(cell, "contrast exchanged", "E of the softest over that of the stiffest phase [-]",
              criterion, decades(1, 16), estimates, contrast, of_sums),
        [=](const double value) { return with_contrast(cell, 1. / value); });
    add(named(cell, "thickness ratio", "thickness of the stiffest phase times this [-]", criterion,
              decades(1, 16), estimates, contrast, of_sums),
        [=](const double value)
        {
          return with_phases(cell, [=](Phase &phase, const bool is_stiffest)
                             { phase.thickness *= is_stiffest ? value : 1.; });
        });
  }
  add(named(cell, "anisotropy", "E along the yarns times this [-]", criterion, decades(1, 16),
            estimates, anisotropy, of_entries),
      [=](const double value)
      { return with_phases(cell, [=](Phase &phase, bool) { phase.E1 *= value; }); });
  for (const double sign : {1., -1.})
    add(named(cell, sign > 0. ? "nu towards 1" : "nu towards -1",
              sign > 0. ? "1/(1 - nu), nu of an orthotropic phase over sqrt(E1/E2) [-]"
                        : "1/(1 + nu), nu of an orthotropic phase over sqrt(E1/E2) [-]",
              criterion, decades(1, 16), estimates, anisotropy, of_entries),
        [=](const double value)
        {
          return with_phases(cell, [=](Phase &phase, bool)
                             { set_poisson(phase, sign * (1. - 1. / value)); });
        });
}

/// What makes the mesh of a cell hard.
void add_meshes(const UnitCell &cell, const int most_triangles, std::vector<StressAxis> &axes)
{
  const char *const criterion = is_laminate(cell) ? of_laminate : of_direct_solve;
  const double flatness       = most_of_linear / meshes::epsilon;
  const std::string of_areas  = "round-off of the area of a flat triangle: 2.2e-16 x length over "
                                "height is 1e-6";
  StressAxis obtuse = named(cell, "obtuse sliver", "longest side over height of one triangle [-]",
                            criterion, decades(1, 16), TheoryOfEnd::estimates, flatness, of_areas);
  obtuse.at = [=](const double value) { return against_theory(with_sliver(cell, 1. / value)); };
  axes.push_back(obtuse);

  StressAxis flat = named(cell, "flat triangles", "factor by which the cell is longer [-]",
                          criterion, decades(1, 16), TheoryOfEnd::estimates, std::sqrt(flatness),
                          "stiffness along and across a flat triangle differ by the square of its "
                          "flatness: times 2.2e-16 "
                          "it is 1e-6");
  flat.at         = [=](const double value)
  { return against_theory(mapped(cell, Eigen::Vector2d(value, 1.).asDiagonal())); };
  axes.push_back(flat);

  std::vector<double> sizes;
  for (int n = 2; sizes.empty() || sizes.back() <= 1e6; n *= 2)
    sizes.push_back(static_cast<double>(n) * n * cell.mesh.n_triangles());
  StressAxis triangles = named(cell, "triangles", "n x n cells as one [triangles]", of_itself,
                               sizes, TheoryOfEnd::estimates, most_of_linear / meshes::epsilon,
                               "round-off of a sum: 2.2e-16 for each triangle is 1e-6");
  triangles.most       = most_triangles;
  triangles.why_most   = "not more than " + short_text(most_triangles) + " triangles are tried";
  triangles.at         = [=](const double value)
  {
    const int n = static_cast<int>(std::lround(std::sqrt(value / cell.mesh.n_triangles())));
    return against_itself(cell, repeated(cell, n, n));
  };
  axes.push_back(triangles);
}

/// What must change nothing.
void add_invariances(const UnitCell &cell, std::vector<StressAxis> &axes)
{
  const TheoryOfEnd promises         = TheoryOfEnd::promises;
  const std::string is_invariant     = "it is the same cloth; round-off and the solver leave 1e-11";
  const std::vector<double> of_turns = {15., 30., 45., 60., 90., 180.};
  StressAxis turned = named(cell, "turned and mirrored", "angle [degrees]", of_itself, of_turns,
                            promises, 180., is_invariant);
  turned.at         = [=](const double value)
  {
    const double angle      = value * M_PI / 180.;
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Eigen::Matrix3d T = homogenization::stiffness_rotation(angle),
                          M = Eigen::Vector3d(1., 1., -1.).asDiagonal();
    StressAnswer plain      = against_itself(cell, mapped(cell, R), T);
    const StressAnswer mirrored =
      against_itself(cell, mapped(cell, R * Eigen::Vector2d(-1., 1.).asDiagonal()), T * M);
    plain.error = larger(plain.error, mirrored.error);
    return plain;
  };
  axes.push_back(turned);

  const double rows = std::sqrt(0.5 * cell.mesh.n_triangles());
  StressAxis moved =
    named(cell, "moved", "distance from the origin [cells]", of_itself, decades(1, 16),
          TheoryOfEnd::estimates, most_of_linear / (rows * meshes::epsilon),
          "round-off of the coordinates of an edge: rows of triangles x 2.2e-16 x "
          "distance is 1e-6");
  moved.at = [=](const double value)
  {
    UnitCell away = cell;
    away.mesh.vertices.rowwise() +=
      value * Eigen::RowVector2d(1., 0.7) * std::sqrt(cell.lattice.area());
    return against_itself(cell, away);
  };
  axes.push_back(moved);

  for (const bool is_length : {true, false})
  {
    StressAxis units = named(cell, is_length ? "unit of length" : "unit of stress",
                             "numbers larger and smaller by this [-]", of_itself, decades(1, 12),
                             promises, 1e9, is_invariant);
    units.at         = [=](const double value)
    {
      StressAnswer worst;
      for (const double factor : {value, 1. / value})
      {
        const Units to = is_length ? Units{factor, factor, 1.} : Units{1., 1., factor};
        StressAnswer next =
          against_itself(cell, in_units(cell, to), Eigen::Matrix3d::Identity(), factor);
        next.error = larger(worst.error, next.error);
        worst      = next;
      }
      return worst;
    };
    axes.push_back(units);
  }
}
} // namespace

std::vector<StressAxis> cell_axes(const UnitCell &cell, const int most_triangles)
{
  std::vector<StressAxis> axes;
  add_phases(cell, axes);
  add_meshes(cell, most_triangles, axes);
  add_invariances(cell, axes);
  return axes;
}
} // namespace homespun::verification
