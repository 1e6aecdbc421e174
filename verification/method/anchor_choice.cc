// SPDX-License-Identifier: MIT
#include "verification/method/anchor_choice.h"

#include "localization/upsampler.h"
#include "verification/method/method.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>

namespace homespun::verification
{
AnchorChoice errors_of_other_anchors(const meshes::HomogenizedCell &cell,
                                     const meshes::TriangleMesh &coarse, const meshes::Sheet &sheet,
                                     const Law law, const meshes::Points &positions,
                                     const meshes::Points &reference)
{
  constexpr int n_grid                   = 4;
  const Eigen::Matrix2d &vectors         = cell.lattice.vectors;
  const Eigen::RowVector2d lattice_point = cell.mesh.vertices.row(cell.anchor);
  std::set<int> anchors;
  for (int i = 0; i < n_grid; ++i)
    for (int j = 0; j < n_grid; ++j)
    {
      const Eigen::RowVector2d point = lattice_point +
                                       (static_cast<double>(i) / n_grid) * vectors.row(0) +
                                       (static_cast<double>(j) / n_grid) * vectors.row(1);
      Eigen::Index nearest = 0;
      (cell.mesh.vertices.rowwise() - point).rowwise().squaredNorm().minCoeff(&nearest);
      anchors.insert(static_cast<int>(nearest));
    }
  AnchorChoice choice           = {std::numeric_limits<double>::infinity(), 0.};
  meshes::HomogenizedCell other = cell;
  for (const int anchor : anchors)
  {
    other.anchor = anchor;
    localization::Upsampler<2, double>::Fine fine;
    localization::Upsampler<2, double>(other, coarse, sheet, Method("localized").options(law))
      .upsample(positions, fine);
    const double error = (fine - reference).rowwise().norm().mean();
    choice.smallest    = std::min(choice.smallest, error);
    choice.largest     = std::max(choice.largest, error);
  }
  return choice;
}

std::string note_of_anchor(const AnchorChoice &choice, const double localized, const double affine,
                           const double bar)
{
  if (choice.largest - choice.smallest <= bar)
    return {};
  char text[400];
  std::snprintf(
    text, sizeof(text),
    "where the cell is cut from the cloth decides: as drawn, chi is zero at the corners of the "
    "cell and the up-sampled error is %.3g %% of the affine one; with chi zero at other points of "
    "the same cell it is %.3g to %.3g %%",
    100. * localized / affine, 100. * choice.smallest / affine, 100. * choice.largest / affine);
  return text;
}
} // namespace homespun::verification
