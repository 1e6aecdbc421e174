// SPDX-License-Identifier: MIT
#include "verification/drape/drape_errors.h"

#include "meshes/plain/errors.h"
#include "verification/record/error_norms.h"

#include <cmath>
#include <limits>

namespace homespun::verification
{
using meshes::SpacePoints;

namespace
{
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// The largest mean fluctuation before a frame [m]; not a number where none is known.
double largest_fluctuation(const std::vector<DrapeRow> &rows, const std::string &cell,
                           const std::string &reference, const int frame)
{
  double largest = not_known;
  for (const DrapeRow &row : rows)
    if (row.cell == cell && row.reference == reference && row.frame < frame && row.mean > 0.)
      largest = std::fmax(largest, row.mean / row.mean_per_fluctuation);
  return largest;
}
} // namespace

DrapeComparison::DrapeComparison(const DrapedCell &draped, const std::vector<std::string> &methods,
                                 const std::vector<CoarseRun> &runs)
    : draped(draped)
    , methods(methods)
    , places(draped.coarse_motion().names())
    , runs(runs)
{
  upsamplers.emplace("affine", draped.upsampler<double>(Method("affine")));
  for (const std::string &method : methods)
    if (upsamplers.count(method) == 0)
      upsamplers.emplace(method, draped.upsampler<double>(Method(method)));
}

SpacePoints DrapeComparison::upsampled(const std::string &method,
                                       const shell::Vectors &coarse) const
{
  Upsampler3d::Fine fine;
  upsamplers.at(method).upsample(coarse, fine);
  return fine;
}

std::vector<meshes::VertexData> DrapeComparison::compare(const std::string &reference,
                                                         const int frame,
                                                         const SpacePoints &positions,
                                                         const DrapeErrorBar &bar,
                                                         DrapeOutput &output) const
{
  const auto at      = static_cast<std::size_t>(frame);
  double fluctuation = not_known, largest = not_known;
  const SpacePoints beginning = draped.at_fine_vertices(draped.fine.positions);
  const double displacement   = (positions - beginning).rowwise().norm().mean();
  std::vector<meshes::VertexData> error;
  for (const CoarseRun &run : runs)
  {
    if (run.frames.size() <= at)
      continue;
    const SpacePoints affine = upsampled("affine", run.frames[at]);
    if (run.is_main)
    {
      fluctuation = (positions - affine).rowwise().norm().mean();
      // Where nothing has moved yet, round-off over round-off is no figure.
      if (fluctuation < 1e-12 * draped.side)
        fluctuation = not_known;
      largest = std::fmax(
        fluctuation, largest_fluctuation(output.error_rows(), draped.cell.name, reference, frame));
    }
    for (const std::string &method : methods)
    {
      if (!belongs(run, draped, method))
        continue;
      const SpacePoints up = method == "affine" ? affine : upsampled(method, run.frames[at]);
      const Eigen::VectorXd distance = (up - positions).rowwise().norm();
      if (!distance.allFinite())
        throw meshes::NotConverged(draped.cell.name + ", " + run.cloth.variant + ", " + method +
                                     ": positions that are not finite",
                                   {});
      DrapeRow row =
        output.error_row(draped.cell.name, run.cloth.variant, reference, method, frame);
      const ErrorNorms norms   = error_norms(distance);
      row.mean                 = norms.mean;
      row.rms                  = norms.rms;
      row.max                  = norms.max;
      row.mean_per_cell        = row.mean / draped.side;
      row.mean_per_fluctuation = row.mean / fluctuation;
      row.displacement         = displacement;
      row.uncertainty          = bar.of_mesh_at(at, largest);
      row.time_step            = bar.of_time_step_at(at, largest);
      output.write(row);
      if (run.is_main && method == "localized")
        error = {{"error", distance.cast<float>()}};
    }
  }
  return error;
}

bool DrapeComparison::has_rows(const std::string &reference, const int frame,
                               const DrapeOutput &output) const
{
  const std::string &cell = draped.cell.name;
  const MovingCloth cloth = {cell, MovingCloth::reference, reference};
  if (!output.has(output.motion_row(cloth, frame, Eigen::RowVector3d::Zero())))
    return false;
  for (const std::string &place : places)
    if (frame > 0 && !output.has_held_force(cloth, frame, place))
      return false;
  for (const CoarseRun &run : runs)
    if (run.frames.size() > static_cast<std::size_t>(frame))
      for (const std::string &method : methods)
        if (belongs(run, draped, method) &&
            !output.has(output.error_row(cell, run.cloth.variant, reference, method, frame)))
          return false;
  return true;
}
} // namespace homespun::verification
