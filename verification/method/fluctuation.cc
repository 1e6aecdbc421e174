// SPDX-License-Identifier: MIT
#include "verification/method/fluctuation.h"

#include "verification/reference/free_sides.h"

#include <chrono>
#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr int quads_per_cell = 4;
} // namespace

FluctuationMeasure::FluctuationMeasure(const Eigen::Matrix3d &stiffness, const meshes::Sheet &sheet,
                                       const Load &load)
    : stiffness(stiffness)
    , load(load)
    , cells(sheet)
    , fine{HomogenizedSheet(stiffness, sheet, load, quads_per_cell * sheet.n1,
                            quads_per_cell * sheet.n2),
           {},
           0.}
    , half_as_fine{HomogenizedSheet(stiffness, sheet, load, quads_per_cell / 2 * sheet.n1,
                                    quads_per_cell / 2 * sheet.n2),
                   {},
                   0.}
{
}

double FluctuationMeasure::distance(Sheet &of, const Law law, const double strain,
                                    const meshes::Points &reference) const
{
  const shell::Positions<2> &rest = of.sheet.mesh.vertices;
  const shell::Positions<2> start =
    of.strain > 0. ? of.sheet.with_held(rest + (strain / of.strain) * of.displacement, strain)
                   : of.sheet.prescribed(strain);
  const shell::Positions<2> positions = of.sheet.solve(law, start);
  of.displacement                     = positions - rest;
  of.strain                           = strain;
  return (reference - of.sheet.at_fine_vertices(law, positions).positions).rowwise().norm().mean();
}

/// A cloth without a microstructure that is pulled moves alike everywhere, on any mesh.
double FluctuationMeasure::distance_of_pulled(const Law law, const double strain,
                                              const meshes::Points &reference) const
{
  const Load pulled = load.with_free_strains([&](const double s)
                                             { return free_strains_of(load, law, stiffness, s); });
  const HomogenizedSheet uniform(stiffness, cells, pulled, cells.n1, cells.n2);
  return (reference - uniform.at_fine_vertices(law, uniform.prescribed(strain)).positions)
    .rowwise()
    .norm()
    .mean();
}

Fluctuation FluctuationMeasure::at(const Law law, const double strain,
                                   const meshes::Points &reference)
{
  const Law beside = homogenized_law(law, stiffness);
  if (beside != last_law)
    fine.strain = half_as_fine.strain = 0.; // levels of another law are no start
  last_law         = beside;
  const auto begin = std::chrono::steady_clock::now();
  Fluctuation found;
  if (load.has_free_sides())
  {
    found.mean = distance_of_pulled(beside, strain, reference);
    return found;
  }
  found.mean    = distance(fine, beside, strain, reference);
  found.bar     = std::abs(found.mean - distance(half_as_fine, beside, strain, reference));
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return found;
}
} // namespace homespun::verification
