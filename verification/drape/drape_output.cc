// SPDX-License-Identifier: MIT
#include "verification/drape/drape_output.h"

#include "localization/vertex_normals.h"
#include "meshes/files/obj_file.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

namespace homespun::verification
{
namespace
{
std::string frame_name(const std::string &what, const int frame, const std::string &format)
{
  char number[16];
  std::snprintf(number, sizeof(number), "%04d", frame);
  return what + "_" + number + "." + format;
}
} // namespace

DrapeOutput::DrapeOutput(std::string folder, std::string scene, const double interval,
                         std::vector<std::string> formats, const bool with_terms)
    : folder(std::move(folder))
    , scene(std::move(scene))
    , interval(interval)
    , formats(std::move(formats))
    , errors(this->folder)
    , motion(this->folder)
    , terms(with_terms ? std::make_unique<Table<TermRow>>(this->folder) : nullptr)
{
}

DrapeRow DrapeOutput::error_row(const std::string &cell, const std::string &variant,
                                const std::string &reference, const std::string &method,
                                const int frame) const
{
  DrapeRow row;
  row.scene     = scene;
  row.cell      = cell;
  row.variant   = variant;
  row.reference = reference;
  row.method    = method;
  row.frame     = frame;
  row.time      = frame * interval;
  return row;
}

MotionRow DrapeOutput::motion_row(const MovingCloth &cloth, const int frame,
                                  const Eigen::RowVector3d &centre) const
{
  MotionRow row;
  row.scene    = scene;
  row.cell     = cloth.cell;
  row.cloth    = cloth.kind;
  row.variant  = cloth.variant;
  row.frame    = frame;
  row.time     = frame * interval;
  row.centre_x = centre(0);
  row.centre_y = centre(1);
  row.centre_z = centre(2);
  return row;
}

void DrapeOutput::write_held_forces(const MovingCloth &cloth, const int frame,
                                    const std::vector<HeldForce> &forces)
{
  for (const HeldForce &its : forces)
  {
    MotionRow row = {scene, cloth.cell, cloth.kind, cloth.variant, frame, its.place};
    row.time      = frame * interval;
    row.force_x   = its.force(0);
    row.force_y   = its.force(1);
    row.force_z   = its.force(2);
    motion.append_if_missing(row);
  }
}

TermRow DrapeOutput::term_row(const std::string &cell, const std::string &term) const
{
  TermRow row;
  row.scene = scene;
  row.cell  = cell;
  row.term  = term;
  return row;
}

void DrapeOutput::write_frame(const Frame &frame, const meshes::SpacePoints &positions,
                              const meshes::Triangles &triangles, const meshes::SurfaceData &data,
                              meshes::FrameCollection *collection) const
{
  for (const std::string &format : formats)
  {
    const std::string name = frame_name(frame.what, frame.number, format);
    const std::string path = folder + "/" + frame.run + "/" + name;
    if (format == "ply")
    {
      const meshes::FloatPoints in_float = positions.cast<float>();
      meshes::write_ply(path, in_float, triangles, data.look,
                        data.look.material.size() == 0
                          ? meshes::FloatPoints()
                          : localization::vertex_normals<float>(in_float, triangles));
    }
    else if (format == "obj")
      meshes::write_obj(path, positions, triangles);
    else
    {
      meshes::write_vtu(path, positions.cast<float>(), triangles, data.on_vertices,
                        data.on_triangles);
      if (collection)
        collection->append(frame.number * interval, name);
    }
  }
}

void DrapeOutput::list_earlier_frames(const std::string &run, const int n,
                                      meshes::FrameCollection &collection) const
{
  for (int frame = 0; frame < n; ++frame)
    if (const std::string name = frame_name("fine", frame, "vtu");
        std::filesystem::exists(folder + "/" + run + "/" + name))
      collection.append(frame * interval, name);
}

std::vector<std::string>
DrapeOutput::worst_errors(const std::map<std::string, std::string> &main_variants) const
{
  std::map<std::string, std::string> methods;
  for (const auto &[cell, variant] : main_variants)
    methods[cell] = judged_method(errors.rows(), cell);
  std::map<std::string, double> worst;
  for (const DrapeRow &row : errors.rows())
    if (row.method == methods.at(row.cell) &&
        (row.variant == main_variants.at(row.cell) || row.variant == row.method) &&
        std::isfinite(row.mean_per_cell))
    {
      double &largest = worst[row.cell + " against " + row.reference + ": largest mean error of `" +
                              row.method + "`"];
      largest         = std::max(largest, row.mean_per_cell);
    }
  std::vector<std::string> lines;
  for (const auto &[what, error] : worst)
    lines.push_back(what + " over time " + short_text(error) + " cell sides");
  return lines;
}
} // namespace homespun::verification
