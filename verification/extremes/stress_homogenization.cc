// SPDX-License-Identifier: MIT
// Stress cases of the unit cell: contrast, Poisson's ratio, anisotropy, slivers, size, ranks;
// stress_symmetry.cc has the rest. What C^H must be is known: layers have a closed form, linear
// elements a factorized cell problem, and a cell that is shifted, doubled, turned, mirrored or
// given in other units is the same cloth. All differences are those of the energy of the worst
// macro strain, so that the soft directions of a cell count as much as its stiff ones.
#include "verification/extremes/stress_cases.h"
#include "verification/extremes/stress_cell_group.h"
#include "verification/extremes/stress_solver.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace homespun::verification
{
namespace
{
/// The limit of what differs from a linear dependence that larger moduli or compliances of the same
/// run show.
Limit of_vanishing(Limit round_off)
{
  round_off.derivation =
    "theory: energies are linear in what vanishes, with the slope that the same run has at 1e-6; " +
    round_off.derivation;
  return round_off;
}

void contrast_cases(const std::vector<UnitCell> &cells, std::vector<StressCase> &cases)
{
  CellGroup group("cell contrast", cases);
  for (const double contrast : {1e0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12})
  {
    const std::string of   = short_text(contrast);
    const UnitCell stripes = stripe_cell(rows_of_built_in, soft_phase(), stiff_phase(contrast));
    const std::string laminated = "is the laminate of the closed form";
    for (const unsigned int order : {1u, 2u})
      group.finite(of + "; stripes; P" + std::to_string(order), laminated, limit_of(stripes),
                   to_closed_form, [=]() { return against_laminate(stripes, order); });
    std::vector<UnitCell> others = {
      inclusion_cell(rows_of_built_in, soft_phase(), stiff_phase(contrast)),
      islands_cell(rows_of_built_in, soft_phase(), stiff_phase(contrast))};
    others[0].name = "square inclusion";
    others[1].name = "two islands";
    for (const UnitCell &cell : cells)
      if (has_contrast(cell))
        others.push_back(with_contrast(cell, contrast));
    for (const UnitCell &cell : others)
      group.finite(of + "; " + cell.name, "is that of a factorized solve", limit_of(cell),
                   to_factorized, [=]() { return against_factorized(cell); });
  }
  const UnitCell void_like = inclusion_cell(rows_of_built_in, soft_phase(), stiff_phase(1e-9));
  group.finite("void of 1e-9; square", "is that of a factorized solve", limit_of(void_like),
               to_factorized, [=]() { return against_factorized(void_like); });
  // Energies are linear in the modulus of a void as it vanishes, and in the compliance of an
  // inclusion as that vanishes. What is left beside the slope that larger ones have is of second
  // order, and round-off.
  const char *const beside_slope =
    "largest relative energy difference, less what the slope between 1e-5 and 1e-6 explains [-]";
  group.finite(
    "void of 1e-9; square; beside a hole", "is the cell with a hole",
    of_vanishing(limit_of(void_like)), beside_slope,
    [=]() -> StressAnswer
    {
      const auto of = [](const double modulus) {
        return solved(inclusion_cell(rows_of_built_in, soft_phase(), stiff_phase(modulus)))
          .stiffness;
      };
      const double slope          = energy_difference(of(1e-5), of(1e-6)) / (1e-5 - 1e-6);
      const Eigen::Matrix3d found = of(1e-9);
      return {std::abs(energy_difference(found, solved(without_phase(void_like, 1)).stiffness) -
                       slope * 1e-9),
              found};
    });
  for (const bool is_disconnected : {false, true})
  {
    const auto with_inclusion = [=](const double contrast)
    {
      return is_disconnected
               ? islands_cell(rows_of_built_in, soft_phase(), stiff_phase(contrast))
               : inclusion_cell(rows_of_built_in, soft_phase(), stiff_phase(contrast));
    };
    group.finite(
      std::string("rigid; ") + (is_disconnected ? "two islands" : "square inclusion") +
        "; 1e9 beside 1e12",
      "has come to its limit", of_vanishing(limit_of(with_inclusion(1e12))), beside_slope,
      [=]() -> StressAnswer
      {
        const auto of = [=](const double contrast)
        { return solved(with_inclusion(contrast)).stiffness; };
        const double slope          = energy_difference(of(1e5), of(1e6)) / (1e-5 - 1e-6);
        const Eigen::Matrix3d found = of(1e9);
        return {std::abs(energy_difference(found, of(1e12)) - slope * (1e-9 - 1e-12)), found};
      });
  }
  group.refused("void of zero stiffness", "Young's modulus 0",
                inclusion_cell(rows_of_built_in, soft_phase(), stiff_phase(0.)));
  group.refused("negative stiffness", "Young's modulus -1e+06",
                inclusion_cell(rows_of_built_in, soft_phase(), stiff_phase(-1.)));
}

void poisson_cases(std::vector<StressCase> &cases)
{
  CellGroup group("cell Poisson's ratio", cases);
  for (const double nu : {-0.99, -0.9, -0.5, 0., 0.3, 0.49, 0.4999, 0.499999, 0.5})
  {
    const UnitCell same    = stripe_cell(rows_of_built_in, soft_phase(nu), soft_phase(nu)),
                   stripes = stripe_cell(rows_of_built_in, soft_phase(nu), stiff_phase(10., nu));
    std::ostringstream of;
    of << nu;
    group.finite(of.str() + "; homogeneous", "is E t / (1 − nu^2) [1 nu; nu 1], E t / (2 (1 + nu))",
                 limit_of(same), to_closed_form,
                 [=]() -> StressAnswer
                 {
                   const Eigen::Matrix3d found = solved(same).stiffness;
                   Eigen::Matrix3d exact;
                   exact << 1., nu, 0., nu, 1., 0., 0., 0., 0.5 * (1. - nu);
                   exact *= 1e6 * 5e-4 / (1. - nu * nu);
                   return {energy_difference(found, exact), found};
                 });
    group.finite(of.str() + "; stripes of contrast 10", "is the laminate of the closed form",
                 limit_of(stripes), to_closed_form, [=]() { return against_laminate(stripes, 1); });
  }
  for (const double nu : {-1., 1., 1.5})
    group.refused(short_text(nu), "Poisson's ratio " + short_text(nu),
                  stripe_cell(rows_of_built_in, soft_phase(), soft_phase(nu)));
}

void anisotropy_cases(std::vector<StressCase> &cases)
{
  CellGroup group("cell anisotropy", cases);
  const UnitCell inclusion = inclusion_cell(rows_of_built_in, soft_phase(), yarn_phase(20.));
  for (const double angle : {0., 15., 30., 45., 60., 75., 90.})
  {
    const std::string of   = "; 1e4 to 1 at " + short_text(angle) + " degrees";
    const UnitCell stripes = stripe_cell(rows_of_built_in, soft_phase(), yarn_phase(angle));
    for (const unsigned int order : {1u, 2u})
      group.finite("yarns turned within stripes; P" + std::to_string(order) + of,
                   "is the laminate of the closed form", limit_of(stripes), to_closed_form,
                   [=]() { return against_laminate(stripes, order); });
    group.finite(
      "homogeneous" + of, "turns with the yarn", limit_of(stripes), to_closed_form,
      [=]() -> StressAnswer
      {
        const Eigen::Matrix3d found =
          solved(stripe_cell(rows_of_built_in, yarn_phase(angle), yarn_phase(angle))).stiffness;
        const Eigen::Matrix3d straight =
          stripe_cell(1, yarn_phase(0.), yarn_phase(0.)).stiffness_of_phase()[0];
        return {energy_difference(found, moved_tensor(straight, turn(angle))), found};
      });
    group.finite("cell turned as a whole" + of, "turns with the cell", limit_of(inclusion),
                 to_original,
                 [=]() { return against(turned(inclusion, angle), inclusion, turn(angle)); });
  }
}

/// Equal lines, and one more just above the interface of the stripes.
GridLines with_thin_row(const double aspect)
{
  GridLines lines = equal_lines(rows_of_built_in);
  lines.insert(lines.begin() + rows_of_built_in / 2 + 1, 0.5 + aspect / rows_of_built_in);
  return lines;
}

void sliver_cases(std::vector<StressCase> &cases)
{
  CellGroup group("cell slivers", cases);
  const auto stripes_on = [](const GridLines &x, const GridLines &y)
  {
    return grid_cell(x, y, {soft_phase(), stiff_phase(10.)},
                     [](double, const double height) { return height < 0.5 ? 0 : 1; });
  };
  for (const double aspect : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
  {
    const std::string of                                        = "; " + short_text(aspect);
    const std::vector<std::pair<std::string, UnitCell>> slivers = {
      {"row of needles along the stripes",
       stripes_on(equal_lines(rows_of_built_in), with_thin_row(aspect))},
      {"row of needles across the stripes",
       stripes_on(with_thin_row(aspect), equal_lines(rows_of_built_in))},
      {"one obtuse triangle",
       capped_stripes(rows_of_built_in, soft_phase(), stiff_phase(10.), aspect)}};
    for (const auto &sliver : slivers)
      if (aspect < 1e-5 && sliver.first != "one obtuse triangle")
        // 6e-8 of the side where they meet the outline, less than the tolerance of images.
        group.refused(sliver.first + of, "count as one", sliver.second);
      else
        group.finite(sliver.first + of, "is the laminate of the closed form",
                     limit_of(sliver.second), to_closed_form,
                     [cell = sliver.second]()
                     {
                       refuse_unsound(cell);
                       return against_laminate(cell, 1);
                     });
  }
  for (const double aspect : {1e-2, 1e-4})
  {
    UnitCell thin = stripe_cell(rows_of_built_in, soft_phase(), stiff_phase(10.));
    thin.mesh.vertices.col(0) *= aspect;
    thin.lattice.vectors.col(0) *= aspect;
    group.finite("a cell that is a sliver; " + short_text(aspect),
                 "is the laminate of the closed form", limit_of(thin), to_closed_form,
                 [=]()
                 {
                   refuse_unsound(thin);
                   return against_laminate(thin, 1);
                 });
  }
  group.refused("one obtuse triangle; 1e-11", "has area",
                capped_stripes(rows_of_built_in, soft_phase(), stiff_phase(10.), 1e-11));
  group.refused("row of needles; 1e-11", "has area",
                stripes_on(equal_lines(rows_of_built_in), with_thin_row(1e-11)));
}

void size_cases(const int most_triangles, std::vector<StressCase> &cases)
{
  CellGroup group("cell size", cases);
  group.finite(
    "two triangles", "is the mean of both: nothing can move",
    {1e-14,
     "round-off: twelve roundings of each entry, of which the softest direction keeps one part in "
     "3.7: 12 x 3.7 x 2.2e-16"},
    "largest relative energy difference to Voigt's mean [-]",
    []() -> StressAnswer
    {
      UnitCell pair = stripe_cell(1, soft_phase(), stiff_phase(10.));
      pair.mesh.material << 0, 1;
      const auto c                = pair.stiffness_of_phase();
      const Eigen::Matrix3d found = solved(pair).stiffness;
      return {energy_difference(found, 0.5 * (c[0] + c[1])), found};
    });
  const UnitCell eight = stripe_cell(2, soft_phase(), stiff_phase(10.));
  group.finite("eight triangles", "is that of a factorized solve", limit_of(eight), to_factorized,
               [=]() { return against_factorized(eight); });
  for (const int triangles : {10000, 100000, 1000000})
    if (triangles <= most_triangles)
    {
      const int rows = 2 * static_cast<int>(std::lround(std::sqrt(triangles / 8.)));
      group.finite(
        short_text(triangles) + " triangles; stripes of contrast 10",
        "is the laminate of the closed form",
        {1e-11 + triangles * std::numeric_limits<double>::epsilon(),
         "round-off: 1e-11 as for up to 1e5 triangles, and one rounding of the mean for each "
         "triangle"},
        to_closed_form,
        [=]() { return against_laminate(stripe_cell(rows, soft_phase(), stiff_phase(10.)), 1); },
        triangles < 100000 ? 2 : 1);
    }
  UnitCell torn = stripe_cell(rows_of_built_in, soft_phase(), stiff_phase(10.));
  torn.mesh.vertices(rows_of_built_in, 1) += 1e-3 * torn.lattice.vectors(1, 1);
  group.refused("a corner off its image by 1e-3 of the side", "no periodic image", torn);
}
} // namespace

std::vector<UnitCell> built_in_cells()
{
  UnitCell stripes   = stripe_cell(rows_of_built_in, soft_phase(), stiff_phase(10.)),
           inclusion = inclusion_cell(rows_of_built_in, soft_phase(), yarn_phase(20.));
  stripes.name       = "built-in stripes";
  inclusion.name     = "built-in square of yarns";
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
  for (const std::vector<StressCase> &some : {symmetry_cases(moved), unit_cases(moved)})
    cases.insert(cases.end(), some.begin(), some.end());
  size_cases(most_triangles, cases);
  CellGroup group("cell ranks", cases);
  for (std::size_t k = 0; k < by_all_ranks.size(); ++k)
    group.finite(std::to_string(n_ranks) + " beside one; " + moved[k].name, "the same C^H",
                 limit_of(moved[k]), "largest relative energy difference to one rank [-]",
                 [cell = moved[k], parallel = by_all_ranks[k]]() -> StressAnswer
                 {
                   const Eigen::Matrix3d alone = solved(cell).stiffness;
                   return {energy_difference(parallel, alone), parallel};
                 });
  return cases;
}
} // namespace homespun::verification
