// SPDX-License-Identifier: MIT
#include "verification/drape_output.h"

#include "meshes/obj_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

namespace homespun::verification
{
namespace
{
const std::vector<std::string> error_columns  = {"scene",
                                                 "cell",
                                                 "variant",
                                                 "reference",
                                                 "method",
                                                 "frame",
                                                 "time_s",
                                                 "error_mean_m",
                                                 "error_rms_m",
                                                 "error_max_m",
                                                 "error_mean_per_cell",
                                                 "error_mean_per_fluctuation",
                                                 "reference_uncertainty_m"};
const std::vector<std::string> motion_columns = {"scene",
                                                 "cell",
                                                 "variant",
                                                 "frame",
                                                 "time_s",
                                                 "centre_x_m",
                                                 "centre_y_m",
                                                 "centre_z_m",
                                                 "kinetic_J",
                                                 "elastic_J",
                                                 "gravity_J",
                                                 "max_stretch",
                                                 "seconds_coarse_step",
                                                 "seconds_upsampling"};
const std::vector<std::string> term_columns   = {"scene",
                                                 "cell",
                                                 "term",
                                                 "present",
                                                 "seconds_per_step",
                                                 "seconds_per_step_forced",
                                                 "bytes",
                                                 "bytes_forced",
                                                 "seconds_spread",
                                                 "seconds_spread_forced"};

void append(ResultTable &table, std::vector<std::string> keys, const std::vector<double> &values)
{
  if (table.contains(keys))
    return;
  for (const double value : values)
    keys.push_back(csv_number(value));
  table.append(keys);
}

std::string frame_name(const std::string &what, const int frame, const std::string &format)
{
  char number[16];
  std::snprintf(number, sizeof(number), "%04d", frame);
  return what + "_" + number + "." + format;
}
} // namespace

DrapeOutput::DrapeOutput(std::string folder, std::string scene, const double interval,
                         std::vector<std::string> formats, const bool with_terms, const bool resume)
    : folder(std::move(folder))
    , scene(std::move(scene))
    , interval(interval)
    , formats(std::move(formats))
{
  const auto open =
    [&](const char *name, const std::vector<std::string> &columns, const std::size_t n_keys)
  { return std::make_unique<ResultTable>(this->folder + "/" + name, columns, n_keys, resume); };
  errors = open("drape.csv", error_columns, 6);
  motion = open("motion.csv", motion_columns, 4);
  if (with_terms)
    terms = open("terms.csv", term_columns, 3);
}

void DrapeOutput::write_error(const std::string &cell, const std::string &variant,
                              const std::string &reference, const std::string &method,
                              const int frame, const ErrorRow &row)
{
  append(*errors, {scene, cell, variant, reference, method, std::to_string(frame)},
         {frame * interval, row.mean, row.rms, row.max, row.per_cell, row.per_fluctuation,
          row.uncertainty});
}

void DrapeOutput::write_motion(const std::string &cell, const std::string &variant, const int frame,
                               const MotionRow &row)
{
  append(*motion, {scene, cell, variant, std::to_string(frame)},
         {frame * interval, row.centre(0), row.centre(1), row.centre(2), row.kinetic, row.elastic,
          row.gravity, row.stretch, row.step_seconds, row.upsampling});
}

bool DrapeOutput::has_error(const std::string &cell, const std::string &variant,
                            const std::string &reference, const std::string &method,
                            const int frame) const
{
  return errors->contains({scene, cell, variant, reference, method, std::to_string(frame)});
}

bool DrapeOutput::has_motion(const std::string &cell, const std::string &variant,
                             const int frame) const
{
  return motion->contains({scene, cell, variant, std::to_string(frame)});
}

bool DrapeOutput::has_term(const std::string &cell, const std::string &term) const
{
  return terms->contains({scene, cell, term});
}

void DrapeOutput::write_term(const std::string &cell, const std::string &term, const TermRow &row)
{
  terms->append({scene, cell, term, row.is_present ? "true" : "false", csv_number(row.time.median),
                 csv_number(row.forced_time.median), std::to_string(row.bytes),
                 row.is_present ? "" : std::to_string(row.forced_bytes),
                 csv_number(row.time.spread), csv_number(row.forced_time.spread)});
}

void DrapeOutput::write_frame(const std::string &run, const std::string &what, const int frame,
                              const meshes::FloatPoints &positions,
                              const meshes::Triangles &triangles,
                              const std::vector<meshes::VertexData> &data,
                              meshes::FrameCollection *collection) const
{
  for (const std::string &format : formats)
  {
    const std::string name = frame_name(what, frame, format);
    const std::string path = folder + "/" + run + "/" + name;
    if (format == "ply")
      meshes::write_ply(path, positions, triangles);
    else if (format == "obj")
      meshes::write_obj(path, positions.cast<double>(), triangles);
    else
    {
      meshes::write_vtu(path, positions, triangles, data);
      if (collection)
        collection->append(frame * interval, name);
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

std::vector<std::string> DrapeOutput::worst_errors() const
{
  std::map<std::string, double> worst;
  for (const std::vector<std::string> &row : errors->rows())
    if (row[2] == "corotational" && row[4] == "localized" && !row[10].empty())
    {
      double &largest = worst[row[1] + " against " + row[3]];
      largest         = std::max(largest, csv_value(row[10]));
    }
  std::vector<std::string> lines;
  for (const auto &[what, error] : worst)
    lines.push_back(what + ": largest mean error of `localized` over time " + csv_number(error) +
                    " cell sides");
  return lines;
}
} // namespace homespun::verification
