// SPDX-License-Identifier: MIT
#include "verification/ellipticity/end_of_path.h"

#include "meshes/plain/refine.h"
#include "verification/record/number_text.h"
#include "verification/reference/fine_reference.h"

namespace homespun::verification
{
namespace
{
EndOnMesh end_on(const meshes::Sheet &sheet, const std::vector<Eigen::Matrix3d> &stiffness,
                 const Load &load, const Law law, const std::vector<double> &strains)
{
  FineReference reference(sheet, stiffness, ReferenceOptions(), MPI_COMM_SELF);
  reference.start(load, law);
  double reached = 0.;
  for (const double strain : strains)
  {
    const ReferenceStep step = reference.advance(strain);
    reached                  = step.reached ? strain : step.stopped_at;
    if (!step.reached)
      break;
  }
  // A small sheet may go farther than the one of the study.
  const double goal          = 2. * strains.back();
  const ReferencePath beyond = reference.follow(goal, (goal - reached) / 16.);
  EndOnMesh found;
  found.end      = beyond.path.end;
  found.farthest = beyond.path.points.empty() ? reached : beyond.path.farthest;
  if (!beyond.path.points.empty())
    found.n_negative = beyond.path.points.back().n_negative;
  if (beyond.positions.rows() > 0)
    found.triangles = together(ellipticity_of_phases(sheet.mesh, stiffness, law, beyond.positions));
  return found;
}

std::string text_of(const EndOnMesh &mesh)
{
  std::string text;
  switch (mesh.end)
  {
  case PathEnd::turned:
    text = "turns back at a strain of " + percent_text(mesh.farthest) + ", with " +
           std::to_string(mesh.n_negative) + " negative eigenvalues behind it";
    break;
  case PathEnd::reached:
    text = "goes on beyond " + percent_text(mesh.farthest);
    break;
  case PathEnd::lost:
    text = "is lost at " + percent_text(mesh.farthest);
    break;
  }
  return mesh.triangles
           ? text + " (least wave there " + short_text(mesh.triangles->least) + " of that at rest)"
           : text;
}
} // namespace

Ending ending_of(const EndOnMesh &mesh)
{
  if (mesh.triangles && mesh.triangles->n_lost > 0)
    return Ending::law;
  switch (mesh.end)
  {
  case PathEnd::turned:
    return Ending::limit_point;
  case PathEnd::reached:
    return Ending::solver;
  case PathEnd::lost:
    break;
  }
  return Ending::unknown;
}

std::optional<Ending> ending_of(const EndOfPath &end)
{
  const Ending ending = ending_of(end.as_given);
  return ending_of(end.refined) == ending ? std::optional(ending) : std::nullopt;
}

EndOfPath end_of_path(const homogenization::UnitCell &cell, const Load &load, const Law law,
                      const std::vector<double> &strains, const int n_cells)
{
  const auto on = [&](const meshes::TriangleMesh &mesh)
  {
    return end_on(meshes::tile(mesh, cell.lattice, n_cells, n_cells), cell.stiffness_of_phase(),
                  load, law, strains);
  };
  return {n_cells, on(cell.mesh), on(meshes::refined(cell.mesh, 1))};
}

std::string text_of(const EndOfPath &end)
{
  const std::string n = std::to_string(end.n_cells);
  std::string text    = "by arc length the path of a sheet of " + n + " x " + n + " cells " +
                     text_of(end.as_given) + ", on its mesh refined once it " +
                     text_of(end.refined);
  const std::optional<Ending> ending = ending_of(end);
  if (!ending)
    return text + ": the two meshes end differently, so that the mesh decides";
  switch (*ending)
  {
  case Ending::limit_point:
    return text + ": a limit point";
  case Ending::law:
    return text + ": the law ends there, and the mesh decides where";
  case Ending::solver:
    return text + ": there the equilibria go on";
  case Ending::unknown:
    break;
  }
  return text + ": what ends it is not known";
}
} // namespace homespun::verification
