// SPDX-License-Identifier: MIT
// What a scene run leaves on the disk as it goes on: the tables drape.csv (errors), motion.csv
// (motion, energies and forces) and terms.csv (what absent terms would cost), and the frames.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/files/surface_files.h"
#include "verification/drape/drape_tables.h"
#include "verification/drape/held_forces.h"
#include "verification/record/table.h"

#include <Eigen/Core>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// Tables and frames in a folder. Rows that are there already are not written again.
class DrapeOutput
{
public:
  /// @param interval between frames [s]
  /// @param formats of the frames: vtu, ply, obj
  /// @param with_terms whether terms.csv is to be written
  /// @throws BadInput where a table in the folder is damaged
  DrapeOutput(std::string folder, std::string scene, double interval,
              std::vector<std::string> formats, bool with_terms);

  /// Rows that have but their keys yet.
  DrapeRow error_row(const std::string &cell, const std::string &variant,
                     const std::string &reference, const std::string &method, int frame) const;
  /// @param centre of the vertex in the middle [m]
  MotionRow motion_row(const MovingCloth &cloth, int frame, const Eigen::RowVector3d &centre) const;
  TermRow term_row(const std::string &cell, const std::string &term) const;

  void write(const DrapeRow &row)
  {
    errors.append_if_missing(row);
  }
  void write(const MotionRow &row)
  {
    motion.append_if_missing(row);
  }
  /// The forces of what is held at a frame.
  void write_held_forces(const MovingCloth &cloth, int frame, const std::vector<HeldForce> &forces);
  void write(const TermRow &row)
  {
    terms->append_if_missing(row);
  }

  const std::vector<DrapeRow> &error_rows() const
  {
    return errors.rows();
  }

  /// Whether a row with these keys is there.
  bool has(const DrapeRow &row) const
  {
    return errors.contains(row);
  }
  bool has(const MotionRow &row) const
  {
    return motion.contains(row);
  }
  bool has_held_force(const MovingCloth &cloth, const int frame, const std::string &place) const
  {
    return motion.contains({scene, cloth.cell, cloth.kind, cloth.variant, frame, place});
  }
  bool has(const TermRow &row) const
  {
    return terms->contains(row);
  }

  struct Frame
  {
    std::string run;  ///< folder of the run, in that of the study
    std::string what; ///< coarse or fine
    int number;
  };

  /// A frame on the disk in every format, in single precision but for .obj; the .vtu is listed in
  /// the collection, where there is one.
  void write_frame(const Frame &frame, const meshes::SpacePoints &positions,
                   const meshes::Triangles &triangles, const meshes::SurfaceData &data,
                   meshes::FrameCollection *collection) const;

  /// Lists the frames that an earlier run wrote.
  void list_earlier_frames(const std::string &run, int n,
                           meshes::FrameCollection &collection) const;

  /// Largest mean error of `localized` over time, in cell sides, of each cell against each
  /// reference; from the table, so that a resumed run speaks of all its frames. Ready lines.
  /// @param main_variants by cell, whose rows count
  std::vector<std::string>
  worst_errors(const std::map<std::string, std::string> &main_variants) const;

  const std::string folder;

private:
  const std::string scene;
  const double interval;
  const std::vector<std::string> formats;
  Table<DrapeRow> errors;
  Table<MotionRow> motion;
  std::unique_ptr<Table<TermRow>> terms; ///< where costs are measured
};
} // namespace homespun::verification
