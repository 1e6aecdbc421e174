// SPDX-License-Identifier: MIT
#include "verification/upsample/coarse_meshes.h"

#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"
#include "verification/record/run_folder.h"

namespace homespun::verification
{
using meshes::Polygons;

Polygons read_in_metres(const std::string &file, const UpsampleOptions &options)
{
  Polygons mesh = meshes::read_polygons(file);
  mesh.positions *= options.unit;
  return mesh;
}

RestMesh read_rest(const UpsampleOptions &options)
{
  RestMesh rest;
  rest.faces = read_in_metres(options.rest_file, options);
  rest.units = {options.rest_file, options.unit, options.vt_unit,
                rest.faces.has_vt && !options.is_flat};
  rest.cloth = rest.units.has_vt ? meshes::read_cloth(options.rest_file, options.vt_unit)
                                 : meshes::flat_cloth(rest.faces, options.rest_file);
  if (rest.units.has_vt)
  {
    rest.cloth.positions   = rest.faces.positions; // in metres
    rest.units.may_be_flat = meshes::is_flat(rest.faces);
  }
  return rest;
}

double check_frames(const std::vector<FrameFile> &frames, const RestMesh &rest,
                    const UpsampleOptions &options)
{
  const localization::CoarseFrames<3> coarse(rest.cloth.rest, {});
  std::vector<std::string> faults;
  double farthest = 0.;
  for (const FrameFile &frame : frames)
    try
    {
      const Polygons mesh = read_in_metres(frame.file, options);
      farthest            = std::max(farthest, mesh.positions.cwiseAbs().maxCoeff());
      std::string fault   = fault_of_frame(mesh, frame.file, rest.faces, options.rest_file);
      if (fault.empty() && !options.accepts_strain)
        fault = question_of_strain(rest.cloth, coarse, frame.file, mesh.positions, rest.units);
      if (!fault.empty())
        faults.push_back(fault);
    }
    catch (const meshes::BadInput &bad)
    {
      faults.insert(faults.end(), bad.faults().begin(), bad.faults().end());
    }
  std::vector<std::string> given = {options.cell_file, options.rest_file, options.validity_file};
  for (const FrameFile &frame : frames)
    given.push_back(frame.file);
  for (const std::string &file : given)
    if (!file.empty() && lies_in(file, options.output))
      faults.push_back(file + ": lies in the folder of the results, " + options.output +
                       "; expected it elsewhere: choose another --output");
  if (faults.empty())
    return farthest;
  constexpr std::size_t most = 10;
  if (faults.size() > most)
  {
    const std::string more = options.rest_file + ": and " + std::to_string(faults.size() - most) +
                             " more faults of frames";
    faults.resize(most);
    faults.push_back(more);
  }
  throw meshes::BadInput(faults);
}
} // namespace homespun::verification
