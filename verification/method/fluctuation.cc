// SPDX-License-Identifier: MIT
#include "verification/method/fluctuation.h"

#include <chrono>
#include <cmath>

namespace homespun::verification
{
bool fluctuates(const meshes::HomogenizedCell &cell, const Eigen::Vector3d &strain)
{
  meshes::Points w = meshes::Points::Zero(cell.chi.rows(), 2);
  for (int a = 0; a < 3; ++a)
    w += strain(a) * cell.chi.middleCols<2>(2 * a);
  return (w.rowwise() - w.row(0)).cwiseAbs().maxCoeff() >= 1e-10 * std::sqrt(cell.lattice.area());
}

FluctuationMeasure::FluctuationMeasure(const meshes::HomogenizedCell &cell,
                                       const meshes::Sheet &sheet, const Load &load)
    : cell(&cell)
    , sheet(&sheet)
    , load(load)
{
}

double FluctuationMeasure::distance(Sheet &of, const double strain, const meshes::Points &reference)
{
  of.last = of.model.solve(strain, of.last ? &*of.last : nullptr);
  return (reference - of.model.upsample(*of.last)).rowwise().norm().mean();
}

Fluctuation FluctuationMeasure::at(const Law law, const double strain,
                                   const meshes::Points &reference)
{
  const Law beside = homogenized_law(law, cell->stiffness);
  const auto make  = [&](const int quads)
  {
    return std::unique_ptr<Sheet>(new Sheet{
      {{*cell}, *sheet, load, Method("affine"), beside, quads_per_cell(*sheet, quads)}, {}});
  };
  if (!fine || fine->model.law != beside) // levels of another law are no start
  {
    fine         = make(4);
    half_as_fine = make(2);
  }
  const auto begin = std::chrono::steady_clock::now();
  Fluctuation found;
  found.mean    = distance(*fine, strain, reference);
  found.bar     = std::abs(found.mean - distance(*half_as_fine, strain, reference));
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return found;
}
} // namespace homespun::verification
