// SPDX-License-Identifier: MIT
// The cell part of METHOD 6: contrast, Poisson's ratio, anisotropy, slivers, symmetry, units, size, ranks.
// What C^H must be is known: layers have a closed form, linear elements a factorized cell problem, and a cell
// that is shifted, doubled, turned, mirrored or given in other units is the same cloth. All differences are those
// of the energy of the worst macro strain, so that the soft directions of a cell count as much as its stiff ones.
#include "verification/result_files.h"
#include "verification/stress_cases.h"
#include "verification/stress_cells.h"
#include "verification/stress_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace homespun::verification
{
using homogenization::isotropic;

namespace
{
constexpr int n = 16; ///< rectangles per side of the built-in cells

const char *const to_closed_form = "largest relative energy difference to the closed form [-]";
const char *const to_factorized =
  "largest relative energy difference to a factorized solve; or violation of Voigt or Reuss [-]";
const char *const to_original =
  "largest relative energy difference to the moved C^H of the cell as it was [-]";

Phase soft(const double nu = 0.3)
{
  return isotropic("soft", 1e6, nu, 5e-4, 400.);
}

Phase stiff(const double contrast, const double nu = 0.3)
{
  return isotropic("stiff", 1e6 * contrast, nu, 5e-4, 400.);
}

/// Ten thousand times as stiff along as across.
Phase yarn(const double angle)
{
  return {"yarn", 1e9, 1e5, 0.3, 1e5, angle, 5e-4, 400.};
}

/// What round-off and the solver may do to a C^H whose discrete problem is solved exactly by theory.
///
/// The error of the energy is the square of that of the displacement: of the tolerance 1e-11 nothing is left,
/// so that 1e-11 covers the summation of up to 1e5 triangles. A stiff part held by a soft one moves as a whole by
/// what the sums of its large forces lose, 2e-16 of them per row of triangles against the soft stiffness. The
/// entries of a phase's stiffness are rounded in parts of the largest: its softest direction keeps as many digits
/// fewer as its anisotropy has.
double algebraic_limit(const UnitCell &cell)
{
  constexpr double epsilon  = std::numeric_limits<double>::epsilon();
  const double rigid_motion = n * epsilon * contrast_of(cell);
  double anisotropy         = 1.;
  for (const Phase &phase : cell.phases)
  {
    UnitCell alone = cell;
    alone.phases   = {phase};
    anisotropy     = std::max(anisotropy, contrast_of(alone));
  }
  return 1e-11 + rigid_motion * rigid_motion + 16. * epsilon * anisotropy;
}

/// By how much the bounds of Voigt and Reuss are violated, relative to the larger side.
double bound_violation(const SolvedCell &found)
{
  const double above = order_violation(found.stiffness, found.voigt);
  return found.reuss.isZero() ? above
                              : larger(above, order_violation(found.reuss, found.stiffness));
}

StressAnswer against_factorized(const UnitCell &cell)
{
  const SolvedCell found = solved(cell);
  return {
    larger(energy_difference(found.stiffness, factorized_stiffness(cell)), bound_violation(found)),
    found.stiffness};
}

/// Layers stacked along axis 2, half of the cell each.
StressAnswer against_laminate(const UnitCell &cell, const unsigned int order)
{
  const SolvedCell found = solved(cell, order);
  return {larger(energy_difference(found.stiffness,
                                   laminate_stiffness(cell.stiffness_of_phase(), {0.5, 0.5})),
                 bound_violation(found)),
          found.stiffness};
}

/// C^H of a cell against that of another, moved.
StressAnswer against(const UnitCell &cell, const UnitCell &original, const Eigen::Matrix2d &Q,
                     const double factor = 1.)
{
  const Eigen::Matrix3d found = solved(cell).stiffness, before = solved(original).stiffness;
  return {energy_difference(found / factor, moved_tensor(before, Q)), found};
}

Eigen::Matrix2d turn(const double angle)
{
  const double a = angle * M_PI / 180.;
  return (Eigen::Matrix2d() << std::cos(a), -std::sin(a), std::sin(a), std::cos(a)).finished();
}

/// Cases of one group.
class Group
{
public:
  Group(std::string name, std::vector<StressCase> &cases)
      : name(std::move(name))
      , cases(cases)
  {
  }

  template <typename Run>
  void finite(const std::string &what, const std::string &expected, const double limit,
              const std::string &figure_is, const Run &run, const int most_repeats = 2)
  {
    cases.push_back({name, what, "finite; " + expected, Ending::finite, limit, figure_is, "", false,
                     [run](unsigned int) -> StressAnswer { return run(); }, most_repeats});
  }

  void refused(const std::string &what, const std::string &names, const UnitCell &cell)
  {
    cases.push_back({name, what, "refused; the message names `" + names + "`", Ending::refused, 0.,
                     "", names, false,
                     [cell](unsigned int) -> StressAnswer
                     {
                       refuse_unsound(cell);
                       return {0., solved(cell).stiffness};
                     },
                     2});
  }

private:
  const std::string name;
  std::vector<StressCase> &cases;
};

void contrast_cases(const std::vector<UnitCell> &cells, std::vector<StressCase> &cases)
{
  Group group("cell contrast", cases);
  for (const double contrast : {1e0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12})
  {
    const std::string of        = csv_number(contrast);
    const UnitCell stripes      = stripe_cell(n, soft(), stiff(contrast));
    const std::string laminated = "is the laminate of the closed form";
    for (const unsigned int order : {1u, 2u})
      group.finite(of + "; stripes; P" + std::to_string(order), laminated, algebraic_limit(stripes),
                   to_closed_form, [=]() { return against_laminate(stripes, order); });
    std::vector<UnitCell> others = {inclusion_cell(n, soft(), stiff(contrast)),
                                    islands_cell(n, soft(), stiff(contrast))};
    others[0].name               = "square inclusion";
    others[1].name               = "two islands";
    for (const UnitCell &cell : cells)
      if (has_contrast(cell))
        others.push_back(with_contrast(cell, contrast));
    for (const UnitCell &cell : others)
      group.finite(of + "; " + cell.name, "is that of a factorized solve", algebraic_limit(cell),
                   to_factorized, [=]() { return against_factorized(cell); });
  }
  const UnitCell void_like = inclusion_cell(n, soft(), stiff(1e-9));
  group.finite("void of 1e-9; square", "is that of a factorized solve", algebraic_limit(void_like),
               to_factorized, [=]() { return against_factorized(void_like); });
  // Energies are linear in the modulus of the void, which is strained some times as much as the cell.
  group.finite(
    "void of 1e-9; square; beside a hole", "is the cell with a hole", 1e-7,
    "largest relative energy difference to the cell without these triangles [-]",
    [=]() -> StressAnswer
    {
      const Eigen::Matrix3d found = solved(void_like).stiffness;
      return {energy_difference(found, solved(without_phase(void_like, 1)).stiffness), found};
    });
  // Complementary energies are linear in the compliance of the inclusion, whose stress is some times the mean.
  for (const bool is_disconnected : {false, true})
    group.finite(std::string("rigid; ") + (is_disconnected ? "two islands" : "square inclusion") +
                   "; 1e9 beside 1e12",
                 "has come to its limit",
                 1e-7 + algebraic_limit(inclusion_cell(n, soft(), stiff(1e12))),
                 "largest relative energy difference [-]",
                 [=]() -> StressAnswer
                 {
                   const auto of = [=](const double contrast)
                   {
                     return solved(is_disconnected ? islands_cell(n, soft(), stiff(contrast))
                                                   : inclusion_cell(n, soft(), stiff(contrast)))
                       .stiffness;
                   };
                   const Eigen::Matrix3d found = of(1e9);
                   return {energy_difference(found, of(1e12)), found};
                 });
  group.refused("void of zero stiffness", "Young's modulus 0",
                inclusion_cell(n, soft(), stiff(0.)));
  group.refused("negative stiffness", "Young's modulus -1e+06",
                inclusion_cell(n, soft(), stiff(-1.)));
}

void poisson_cases(std::vector<StressCase> &cases)
{
  Group group("cell Poisson's ratio", cases);
  for (const double nu : {-0.99, -0.9, -0.5, 0., 0.3, 0.49, 0.4999, 0.499999, 0.5})
  {
    const UnitCell same    = stripe_cell(n, soft(nu), soft(nu)),
                   stripes = stripe_cell(n, soft(nu), stiff(10., nu));
    std::ostringstream of;
    of << nu;
    group.finite(of.str() + "; homogeneous", "is E t / (1 − nu^2) [1 nu; nu 1], E t / (2 (1 + nu))",
                 algebraic_limit(same), to_closed_form,
                 [=]() -> StressAnswer
                 {
                   const Eigen::Matrix3d found = solved(same).stiffness;
                   Eigen::Matrix3d exact;
                   exact << 1., nu, 0., nu, 1., 0., 0., 0., 0.5 * (1. - nu);
                   exact *= 1e6 * 5e-4 / (1. - nu * nu);
                   return {energy_difference(found, exact), found};
                 });
    group.finite(of.str() + "; stripes of contrast 10", "is the laminate of the closed form",
                 algebraic_limit(stripes), to_closed_form,
                 [=]() { return against_laminate(stripes, 1); });
  }
  for (const double nu : {-1., 1., 1.5})
    group.refused(csv_number(nu), "Poisson's ratio " + csv_number(nu),
                  stripe_cell(n, soft(), soft(nu)));
}

void anisotropy_cases(std::vector<StressCase> &cases)
{
  Group group("cell anisotropy", cases);
  const UnitCell inclusion = inclusion_cell(n, soft(), yarn(20.));
  for (const double angle : {0., 15., 30., 45., 60., 75., 90.})
  {
    const std::string of   = "; 1e4 to 1 at " + csv_number(angle) + " degrees";
    const UnitCell stripes = stripe_cell(n, soft(), yarn(angle));
    for (const unsigned int order : {1u, 2u})
      group.finite(
        "yarns turned within stripes; P" + std::to_string(order) + of,
        "is the laminate of the closed form", algebraic_limit(stripes), to_closed_form,
        [=]() { return against_laminate(stripes, order); }, 1);
    group.finite(
      "homogeneous" + of, "turns with the yarn", algebraic_limit(stripes), to_closed_form,
      [=]() -> StressAnswer
      {
        const Eigen::Matrix3d found    = solved(stripe_cell(n, yarn(angle), yarn(angle))).stiffness;
        const Eigen::Matrix3d straight = stripe_cell(1, yarn(0.), yarn(0.)).stiffness_of_phase()[0];
        return {energy_difference(found, moved_tensor(straight, turn(angle))), found};
      });
    group.finite("cell turned as a whole" + of, "turns with the cell", algebraic_limit(inclusion),
                 to_original,
                 [=]() { return against(turned(inclusion, angle), inclusion, turn(angle)); });
  }
}

/// Equal lines, and one more just above the interface of the stripes.
GridLines with_thin_row(const double aspect)
{
  GridLines lines = equal_lines(n);
  lines.insert(lines.begin() + n / 2 + 1, 0.5 + aspect / n);
  return lines;
}

void sliver_cases(std::vector<StressCase> &cases)
{
  Group group("cell slivers", cases);
  const auto stripes_on = [](const GridLines &x, const GridLines &y)
  {
    return grid_cell(x, y, {soft(), stiff(10.)},
                     [](double, const double height) { return height < 0.5 ? 0 : 1; });
  };
  for (const double aspect : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
  {
    const std::string of                                        = "; " + csv_number(aspect);
    const std::vector<std::pair<std::string, UnitCell>> slivers = {
      {"row of needles along the stripes", stripes_on(equal_lines(n), with_thin_row(aspect))},
      {"row of needles across the stripes", stripes_on(with_thin_row(aspect), equal_lines(n))},
      {"one obtuse triangle", capped_stripes(n, soft(), stiff(10.), aspect)}};
    for (const auto &sliver : slivers)
      if (aspect < 1e-5 && sliver.first != "one obtuse triangle")
        // 6e-8 of the side where they meet the outline, less than the tolerance of images.
        group.refused(sliver.first + of, "count as one", sliver.second);
      else
        group.finite(sliver.first + of, "is the laminate of the closed form",
                     algebraic_limit(sliver.second), to_closed_form,
                     [cell = sliver.second]()
                     {
                       refuse_unsound(cell);
                       return against_laminate(cell, 1);
                     });
  }
  for (const double aspect : {1e-2, 1e-4})
  {
    UnitCell thin = stripe_cell(n, soft(), stiff(10.));
    thin.mesh.vertices.col(0) *= aspect;
    thin.lattice.vectors.col(0) *= aspect;
    group.finite("a cell that is a sliver; " + csv_number(aspect),
                 "is the laminate of the closed form", algebraic_limit(thin), to_closed_form,
                 [=]()
                 {
                   refuse_unsound(thin);
                   return against_laminate(thin, 1);
                 });
  }
  group.refused("one obtuse triangle; 1e-11", "has area",
                capped_stripes(n, soft(), stiff(10.), 1e-11));
  group.refused("row of needles; 1e-11", "has area",
                stripes_on(equal_lines(n), with_thin_row(1e-11)));
}

void symmetry_cases(const std::vector<UnitCell> &cells, std::vector<StressCase> &cases)
{
  Group group("cell symmetry", cases);
  const Eigen::Matrix2d as_it_was = Eigen::Matrix2d::Identity();
  for (const UnitCell &cell : cells)
  {
    const std::string of = "; " + cell.name;
    const double limit   = algebraic_limit(cell);
    for (const auto &[f1, f2] : {std::pair{0.5, 0.}, {0.25, 0.5}, {0.3125, 0.6875}})
    {
      const Eigen::RowVector2d origin(f1, f2);
      group.finite("cut elsewhere; by " + csv_number(f1) + " and " + csv_number(f2) + of,
                   "the same cloth", limit, to_original,
                   [=]() { return against(shifted(cell, origin), cell, as_it_was); });
    }
    for (const double far : {1e2, 1e4})
    {
      UnitCell away = cell;
      away.mesh.vertices.rowwise() +=
        far * Eigen::RowVector2d(1., 0.7) * std::sqrt(cell.lattice.area());
      // Coordinates lose so many digits, edges as many more as they are shorter than the cell.
      const double lost = far * std::sqrt(cell.mesh.n_triangles()) * 1e-15;
      group.finite("moved by " + csv_number(far) + " cells" + of, "the same cloth",
                   limit + 10. * lost, to_original,
                   [=]() { return against(away, cell, as_it_was); });
    }
    for (const auto &[n1, n2] : {std::pair{1, 1}, {2, 1}, {2, 2}, {3, 3}, {4, 4}})
      group.finite("repeated " + std::to_string(n1) + " x " + std::to_string(n2) + of,
                   "the same cloth", limit, to_original,
                   [=, n1 = n1, n2 = n2]()
                   { return against(repeated(cell, n1, n2), cell, as_it_was); });
    for (const double angle : {15., 45., 90., 180.})
      group.finite("turned by " + csv_number(angle) + " degrees" + of, "C^H turns with the cell",
                   limit, to_original,
                   [=]() { return against(turned(cell, angle), cell, turn(angle)); });
    const Eigen::Matrix2d mirror = Eigen::Vector2d(-1., 1.).asDiagonal();
    group.finite("mirrored" + of, "C^H is mirrored", limit, to_original,
                 [=]() { return against(mirrored(cell), cell, mirror); });
    group.finite("mirrored; turned by 30 degrees; cut elsewhere" + of, "C^H moves with the cell",
                 limit, to_original,
                 [=]()
                 {
                   return against(shifted(turned(mirrored(cell), 30.), {0.4375, 0.3125}), cell,
                                  turn(30.) * mirror);
                 });
    UnitCell inside_out = cell;
    inside_out.mesh.vertices.col(0) *= -1.;
    inside_out.lattice.vectors.col(0) *= -1.;
    group.refused("mirrored; triangles left clockwise" + of, "inverted", inside_out);
  }
}

void unit_cases(const std::vector<UnitCell> &cells, std::vector<StressCase> &cases)
{
  struct Units
  {
    const char *name;
    double length, thickness, modulus;
  };
  // A length of 1 m is 1000 mm; 1 Pa is 1e-9 GPa.
  constexpr Units units[] = {{"mm and Pa", 1e3, 1e3, 1.},
                             {"cm and Pa", 1e2, 1e2, 1.},
                             {"m and GPa", 1., 1., 1e-9},
                             {"mm and GPa", 1e3, 1e3, 1e-9},
                             {"mm in the plane alone", 1e3, 1., 1.},
                             {"km and Pa", 1e-3, 1e-3, 1.},
                             {"nm and nPa", 1e9, 1e9, 1e9}};
  Group group("cell units", cases);
  for (const UnitCell &cell : cells)
    for (const Units &unit : units)
      group.finite(std::string(unit.name) + "; " + cell.name, "the same cloth",
                   algebraic_limit(cell),
                   "largest relative energy difference to that in m and Pa [-]",
                   [=]()
                   {
                     return against(in_units(cell, unit.length, unit.thickness, unit.modulus), cell,
                                    Eigen::Matrix2d::Identity(), unit.thickness * unit.modulus);
                   });
}

void size_cases(const int most_triangles, std::vector<StressCase> &cases)
{
  Group group("cell size", cases);
  group.finite("two triangles", "is the mean of both: nothing can move", 1e-14,
               "largest relative energy difference to Voigt's mean [-]",
               []() -> StressAnswer
               {
                 UnitCell pair = stripe_cell(1, soft(), stiff(10.));
                 pair.mesh.material << 0, 1;
                 const auto c                = pair.stiffness_of_phase();
                 const Eigen::Matrix3d found = solved(pair).stiffness;
                 return {energy_difference(found, 0.5 * (c[0] + c[1])), found};
               });
  group.finite("eight triangles", "is that of a factorized solve", 1e-11, to_factorized,
               []() { return against_factorized(stripe_cell(2, soft(), stiff(10.))); });
  for (const int triangles : {10000, 100000, 1000000})
    if (triangles <= most_triangles)
    {
      const int rows = 2 * static_cast<int>(std::lround(std::sqrt(triangles / 8.)));
      group.finite(
        csv_number(triangles) + " triangles; stripes of contrast 10",
        "is the laminate of the closed form",
        // One rounding of the mean for each triangle.
        1e-11 + triangles * std::numeric_limits<double>::epsilon(), to_closed_form,
        [=]() { return against_laminate(stripe_cell(rows, soft(), stiff(10.)), 1); }, 1);
    }
  UnitCell torn = stripe_cell(n, soft(), stiff(10.));
  torn.mesh.vertices(n, 1) += 1e-3 * torn.lattice.vectors(1, 1);
  group.refused("a corner off its image by 1e-3 of the side", "no periodic image", torn);
}
} // namespace

std::vector<UnitCell> built_in_cells()
{
  UnitCell stripes   = stripe_cell(n, soft(), stiff(10.)),
           inclusion = inclusion_cell(n, soft(), yarn(20.));
  stripes.name       = "stripes";
  inclusion.name     = "square of yarns";
  return {stripes, inclusion};
}

std::vector<StressCase> cell_cases(const std::vector<UnitCell> &cells,
                                   const std::vector<Eigen::Matrix3d> &by_all_ranks,
                                   const int n_ranks, const int most_triangles)
{
  std::vector<StressCase> cases;
  std::vector<UnitCell> moved = built_in_cells();
  moved.insert(moved.end(), cells.begin(), cells.end());
  contrast_cases(cells, cases);
  poisson_cases(cases);
  anisotropy_cases(cases);
  sliver_cases(cases);
  symmetry_cases(moved, cases);
  unit_cases(moved, cases);
  size_cases(most_triangles, cases);
  Group group("cell ranks", cases);
  for (std::size_t k = 0; k < by_all_ranks.size(); ++k)
    group.finite(std::to_string(n_ranks) + " beside one; " + moved[k].name, "the same C^H",
                 algebraic_limit(moved[k]), "largest relative energy difference to one rank [-]",
                 [cell = moved[k], parallel = by_all_ranks[k]]() -> StressAnswer
                 {
                   const Eigen::Matrix3d alone = solved(cell).stiffness;
                   return {energy_difference(parallel, alone), parallel};
                 });
  return cases;
}
} // namespace homespun::verification
