// SPDX-License-Identifier: MIT
#include "verification/upsample/upsample_study.h"

#include "localization/vertex_normals.h"
#include "meshes/files/cell_file.h"
#include "meshes/files/frame_caches.h"
#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"
#include "verification/record/checksum.h"
#include "verification/record/json_files.h"
#include "verification/record/number_text.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"
#include "verification/record/run_folder.h"
#include "verification/record/table.h"
#include "verification/record/timing.h"
#include "verification/upsample/coarse_indicators.h"
#include "verification/upsample/coarse_meshes.h"
#include "verification/upsample/frame_files.h"
#include "verification/upsample/upsampled_cloth.h"
#include "verification/upsample/valid_strain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>

namespace homespun::verification
{
namespace fs = std::filesystem;
using meshes::Polygons;
using nlohmann::ordered_json;

namespace
{
/// The indicators by their names in the table, with what they are.
struct Indicator
{
  const char *name;
  Eigen::VectorXd TriangleIndicators::*values;
  const char *meaning;
};
constexpr std::array<Indicator, 3> indicators = {
  {{"strain", &TriangleIndicators::strain,
    "largest principal value of |E|, E = U - I: against the range of validity of the cell"},
   {"strain_change", &TriangleIndicators::change,
    "change of E across one cell, l max |d . grad E|: homogenization takes it to be zero"},
   {"compression", &TriangleIndicators::compression,
    "1 - smallest principal stretch, where that is below 1: slack cloth wrinkles below the mesh"}}};

/// The fine cloth of a frame; normals where the surface is curved and a file takes them.
struct FineFrame
{
  meshes::FloatPoints positions, normals;
};

class UpsampleStudy
{
public:
  explicit UpsampleStudy(const UpsampleOptions &options)
      : options(options)
      , cell(meshes::read_cell(options.cell_file))
      , rest(read_rest(options))
      , frames(frames_of(options.frames))
  {
  }

  void run()
  {
    const double cell_side = std::sqrt(cell.lattice.area());
    if (const std::string question = question_of_cells(rest.cloth, cell_side, rest.units);
        !question.empty() && !options.accepts_strain)
      throw meshes::BadInput(question);
    farthest                  = check_frames(frames, rest, options);
    const meshes::Grain grain = {{options.origin[0], options.origin[1]},
                                 options.angle * M_PI / 180.};
    fine                      = std::make_unique<UpsampledCloth>(
      cell, rest.cloth, grain, localization::Method(options.method),
      localization::GivenCloth{options.held, options.slip, {}});
    if (fine->method.used.has(localization::Term::micro))
      valid =
        valid_strain(cell, options.cell_file, options.validity_file, options.limit, fine->method);
    if (!fine->method.left_out.empty() && !options.quiet)
      std::fprintf(stderr, "homespun: %s\n", fine->method.left_out.c_str());
    indicators_of = std::make_unique<CoarseIndicators>(fine->coarse, cell_side);
    const auto folder =
      open_run_folder(options.output, {"upsample", inputs()}, options.earlier, options.quiet);
    table = std::make_unique<Table<UpsampleRow>>(options.output);
    Progress progress(!options.quiet, static_cast<int>(frames.size()));
    begin_caches();
    for (const FrameFile &frame : frames)
    {
      progress.begin(frame.name);
      upsample(frame);
      progress.done();
    }
    if (cache)
      cache->finish();
    if (animation)
      animation->finish();
    names = names_in_folder();
    if (has_format("vtu"))
      write_collection();
    write_json(options.output + "/upsample.json", description());
    folder->finish();
  }

  /// What the run came to, line by line.
  std::vector<std::string> summary() const
  {
    const std::size_t n_before     = names.size() - frames.size();
    std::vector<std::string> lines = {
      std::to_string(names.size()) + (names.size() == 1 ? " frame of " : " frames of ") +
      fine->description + ", " + std::to_string(fine->triangles.rows()) +
      " fine triangles: " + options.output +
      (n_before == 0
         ? ""
         : "; of them " + std::to_string(n_before) + " of earlier calls" +
             (cache || animation ? ", which are not in frames.pc2 and frames.usda" : ""))};
    for (const Indicator &indicator : indicators)
    {
      const UpsampleRow row = worst_row(indicator.name);
      lines.push_back(std::string(indicator.name) + ": largest " + short_text(row.largest) +
                      " in " + row.frame + ", triangle " + std::to_string(row.worst) +
                      " at rest (" + short_text(row.worst_rest_1) + ", " +
                      short_text(row.worst_rest_2) + ") m, there " + short_text(row.quantile) +
                      " on 99 % of the area" + beyond_text(row));
    }
    lines.push_back(validity_text());
    for (const std::string &note :
         {note_on_place(farthest, std::sqrt(cell.lattice.area())), note_on_keywords(passed_over)})
      if (!note.empty())
        lines.push_back(note);
    return lines;
  }

private:
  /// The same, and what was said before.
  std::vector<std::string> notes() const
  {
    std::vector<std::string> lines = summary();
    if (!fine->method.left_out.empty())
      lines.push_back(fine->method.left_out);
    return lines;
  }

  bool has_format(const std::string &name) const
  {
    return std::find(options.formats.begin(), options.formats.end(), name) != options.formats.end();
  }

  /// All that a frame's result depends on but for the frame itself, which the table names.
  ordered_json inputs() const
  {
    return {{"cell", checksum_of_file(options.cell_file)},
            {"rest", checksum_of_file(options.rest_file)},
            {"formats", options.formats},
            {"origin_m", options.origin},
            {"angle_degrees", options.angle},
            {"unit_m", options.unit},
            {"vt_unit_m", options.vt_unit},
            {"flat", options.is_flat},
            {"up", options.up},
            {"method", options.method},
            {"held", options.held},
            {"slip", options.slip == localization::Slip::of_cloth},
            {"valid_strain", valid ? ordered_json(valid->strain) : ordered_json()}};
  }

  static bool is_of_all_frames(const std::string &format)
  {
    return format == "pc2" || format == "usda";
  }

  /// The files that hold all frames of this call.
  void begin_caches()
  {
    const int n_points = fine->upsampler->n_fine(), n_frames = static_cast<int>(frames.size());
    if (has_format("pc2"))
      cache = std::make_unique<meshes::PointCache>(path_of("frames", "pc2"), n_points, n_frames);
    if (has_format("usda"))
      animation = std::make_unique<meshes::UsdAnimation>(
        path_of("frames", "usda"), n_points, fine->triangles, fine->look,
        meshes::UsdStage{options.up == "y" ? meshes::UpAxis::y : meshes::UpAxis::z, n_frames});
  }

  std::string path_of(const std::string &frame, const std::string &format) const
  {
    return options.output + "/" + frame + "." + format;
  }

  /// Whether everything that is made of a frame is there, of a file with this checksum where one
  /// is given.
  bool is_made(const std::string &frame, const std::optional<std::string> &checksum) const
  {
    std::size_t n_rows = 0;
    for (const UpsampleRow &row : table->rows())
      n_rows += row.frame == frame && (!checksum || row.checksum == *checksum) ? 1 : 0;
    return n_rows == indicators.size() &&
           std::all_of(options.formats.begin(), options.formats.end(),
                       [&](const std::string &format)
                       { return is_of_all_frames(format) || fs::exists(path_of(frame, format)); });
  }

  /// The frames that are there, those of earlier calls too, as comes_before() has them.
  std::vector<std::string> names_in_folder() const
  {
    std::vector<std::string> found;
    for (const UpsampleRow &row : table->rows())
      if (row.indicator == indicators.front().name && is_made(row.frame, {}))
        found.push_back(row.frame);
    std::sort(found.begin(), found.end(), comes_before);
    return found;
  }

  void write_collection() const
  {
    meshes::FrameCollection collection(options.output + "/frames.pvd");
    for (std::size_t k = 0; k < names.size(); ++k)
      collection.append(static_cast<double>(k), names[k] + ".vtu");
  }

  void upsample(const FrameFile &frame)
  {
    const std::string checksum = checksum_of_file(frame.file);
    const bool is_there        = is_made(frame.name, checksum);
    if (is_there && !cache && !animation)
      return;
    Polygons mesh;
    seconds["read"].push_back(seconds_of([&]() { mesh = read_in_metres(frame.file, options); }));
    passed_over.insert(mesh.passed_over.begin(), mesh.passed_over.end());
    // The file may have been written anew since it was checked.
    if (const std::string fault = fault_of_frame(mesh, frame.file, rest.faces, options.rest_file);
        !fault.empty())
      throw meshes::BadInput(fault);
    FineFrame found;
    const bool has_normals = fine->method.used.has(localization::Term::curved) && has_format("ply");
    seconds["upsample"].push_back(seconds_of(
      [&]()
      {
        has_normals ? fine->upsampler->upsample(mesh.positions, found.positions, found.normals)
                    : fine->upsampler->upsample(mesh.positions, found.positions);
      }));
    if (cache)
      seconds["write_pc2"].push_back(seconds_of([&]() { cache->append(found.positions); }));
    if (animation)
      seconds["write_usda"].push_back(seconds_of([&]() { animation->append(found.positions); }));
    if (is_there)
      return;
    TriangleIndicators values;
    seconds["indicators"].push_back(
      seconds_of([&]() { values = indicators_of->of(mesh.positions); }));
    for (const std::string &format : options.formats)
      if (!is_of_all_frames(format))
        seconds["write_" + format].push_back(
          seconds_of([&]() { write(path_of(frame.name, format), format, found, values); }));
    // What a run that was killed, or another file of this name, has left.
    table->keep([&](const UpsampleRow &row) { return row.frame != frame.name; });
    for (const Indicator &indicator : indicators)
    {
      UpsampleRow row = indicators_of->row_of(
        values.*indicator.values, limit_of(indicator.name, mesh.positions), mesh.positions);
      row.frame     = frame.name;
      row.indicator = indicator.name;
      row.checksum  = checksum;
      table->append(row);
    }
  }

  double limit_of(const std::string &indicator, const meshes::SpacePoints &positions) const
  {
    if (indicator == "compression")
      return indicators_of->round_off(positions);
    return indicator == "strain" && valid ? valid->strain
                                          : std::numeric_limits<double>::quiet_NaN();
  }

  void write(const std::string &path, const std::string &format, const FineFrame &found,
             const TriangleIndicators &values) const
  {
    const meshes::FloatPoints &positions = found.positions;
    if (format == "ply")
      meshes::write_ply(path, positions, fine->triangles, fine->look,
                        found.normals.rows() > 0
                          ? found.normals
                          : localization::vertex_normals<float>(positions, fine->triangles));
    else if (format == "obj")
      meshes::write_obj(path, positions.cast<double>(), fine->triangles);
    else
    {
      std::vector<meshes::VertexData> data;
      for (const Indicator &indicator : indicators)
      {
        const Eigen::VectorXf of_coarse = (values.*indicator.values).cast<float>();
        Eigen::VectorXf at_fine(fine->coarse_triangle.size());
        for (Eigen::Index v = 0; v < at_fine.size(); ++v)
          at_fine(v) = of_coarse(fine->coarse_triangle(v));
        data.push_back({std::string(indicator.name) + " [-]", at_fine});
      }
      meshes::write_vtu(path, positions, fine->triangles, data,
                        {{"material", fine->look.material.cast<float>()}});
    }
  }

  /// The row with the largest value of an indicator over the frames in the folder.
  UpsampleRow worst_row(const std::string &indicator) const
  {
    UpsampleRow worst;
    worst.largest = -1.;
    for (const UpsampleRow &row : table->rows())
      if (row.indicator == indicator && row.largest > worst.largest &&
          std::find(names.begin(), names.end(), row.frame) != names.end())
        worst = row;
    return worst;
  }

  static std::string beyond_text(const UpsampleRow &row)
  {
    if (!row.beyond)
      return "";
    return "; " + std::to_string(*row.beyond) + " of " + std::to_string(row.triangles) +
           " triangles above " + short_text(row.limit) +
           (row.indicator == "compression" ? ", the rounding of positions in single precision"
                                           : "");
  }

  std::string validity_text() const
  {
    if (!fine->method.used.has(localization::Term::micro))
      return "strain: a range of validity is one of up-sampling, which `" + options.method +
             "` has none of; the largest one is told as it is";
    if (!valid)
      return "strain: no range of validity is known, the largest one is told as it is; `homespun "
             "strain` measures one, --validity takes it";
    return "strain: cell " + valid->cell + " was found valid " +
           (valid->is_open ? "at least up to " : "up to ") + short_text(valid->strain) +
           " (mean error of " + valid->method +
           (are_alike_in_a_plane(localization::Method(valid->method), fine->method.used)
              ? ""
              : ", not of what " + options.method + " has here,") +
           " within " + short_text(100. * valid->limit) + " % of the cell side against " +
           valid->law + "; " + valid->load + " decides" + valid->unknown + "; " + valid->file + ")";
  }

  ordered_json description() const
  {
    ordered_json of_indicators = ordered_json::object(), times = ordered_json::object();
    for (const Indicator &indicator : indicators)
      of_indicators[indicator.name] = indicator.meaning;
    for (const auto &[what, all] : seconds)
      times[what] = json_number(median(all));
    return {{"command", options.command},
            {"cell", options.cell_file},
            {"rest", options.rest_file},
            {"cloth", fine->description},
            {"frames", names.size()},
            {"coarse_triangles", fine->coarse.n_triangles()},
            {"fine_vertices", fine->upsampler->n_fine()},
            {"fine_triangles", fine->triangles.rows()},
            {"inputs", inputs()},
            {"indicators", of_indicators},
            {"notes", notes()},
            {"seconds_per_frame", times},
            {"provenance", provenance(1)}};
  }

  const UpsampleOptions options;
  const meshes::HomogenizedCell cell;
  const RestMesh rest;
  const std::vector<FrameFile> frames; ///< of this call
  std::set<std::string> passed_over;   ///< in them
  double farthest = 0.;                ///< coordinate of the frames [m]
  std::vector<std::string> names;      ///< of all frames in the folder, once this call's are made
  std::optional<ValidStrain> valid;
  std::unique_ptr<UpsampledCloth> fine;
  std::unique_ptr<meshes::PointCache> cache;       ///< where they are asked for
  std::unique_ptr<meshes::UsdAnimation> animation; ///< the same
  std::unique_ptr<CoarseIndicators> indicators_of;
  std::unique_ptr<Table<UpsampleRow>> table;
  std::map<std::string, std::vector<double>> seconds; ///< of each part of each frame
};
} // namespace

void run_upsample_study(const UpsampleOptions &options)
{
  UpsampleStudy study(options);
  study.run();
  if (!options.quiet)
    for (const std::string &line : study.summary())
      std::printf("%s\n", line.c_str());
}
} // namespace homespun::verification
