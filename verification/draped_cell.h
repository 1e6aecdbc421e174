// SPDX-License-Identifier: MIT
// One cell in one scene: the coarse cloth with its effective material, the fine cloth with its phases, and
// the ways between them; and the full-resolution runs, in two codes behind one face.
#pragma once

#include "homogenization/unit_cell.h"
#include "localization/upsampler.h"
#include "meshes/fine_cloth.h"
#include "meshes/sheet.h"
#include "meshes/state_file.h"
#include "meshes/surface_files.h"
#include "verification/laws.h"
#include "verification/lightweight_cloth.h"
#include "verification/scene_cloth.h"

#include <mpi.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
using Upsampler3f = localization::Upsampler<3, float>;
using Upsampler3d = localization::Upsampler<3, double>;

/// The scene on a smaller or larger sheet: translations of handles go with its size.
Scene scaled(const Scene &scene, int n_cells);

class DrapedCell
{
public:
  /// @throws BadInput where the cloth of the scene or the cell cannot be used
  DrapedCell(const Scene &scene, const homogenization::UnitCell &cell,
             const meshes::HomogenizedCell &homogenized);

  HeldMotion coarse_motion() const;
  HeldMotion fine_motion() const;

  template <typename Scalar>
  localization::Upsampler<3, Scalar> upsampler(const Method &method) const
  {
    const localization::UpsamplerOptions options = method.options(Law::biot);
    if (sheet)
      return {homogenized, coarse.rest, *sheet, options};
    return {homogenized, coarse, *garment, options};
  }

  /// Vertices that up-sampling gives.
  int n_fine() const;

  /// Triangles between those.
  meshes::Triangles fine_triangles() const;

  /// The phases, for pictures.
  const std::vector<meshes::VertexData> &fine_data() const
  {
    return data;
  }

  /// Positions at the vertices that up-sampling gives, from those of `fine`.
  meshes::SpacePoints at_fine_vertices(const meshes::SpacePoints &positions) const;

  const Scene scene;
  const homogenization::UnitCell cell;
  const meshes::HomogenizedCell homogenized;
  const double side; ///< sqrt(|Y|) [m]
  std::optional<meshes::Sheet> sheet;
  std::optional<meshes::FineCloth> garment;
  meshes::ClothMesh coarse, fine; ///< of `fine`, the vertices in space that the shell moves
  ClothMaterial effective, phases;
  int centre_vertex = 0, fine_centre_vertex = 0; ///< nearest to the middle of the cloth
  std::optional<SheetPlacement> placement;

private:
  std::vector<meshes::VertexData> data;
  std::vector<int> space_vertex; ///< of a garment's fine vertex
};

/// The coarse cloth of one variant at every frame.
struct CoarseRun
{
  std::string variant, failure;
  std::vector<shell::Vectors> frames; ///< (n_coarse,3) [m]
  double seconds_per_step = 0., seconds_per_upsampling = 0.;
};

/// Discretization error of a reference on a small sheet, per frame.
struct ErrorBar
{
  std::vector<double> difference;  ///< mean |P1 − P2| [m]
  std::vector<double> fluctuation; ///< mean |P2 − coarse motion| [m]

  /// Carried over to a sheet with another fluctuation; nothing known: not a number.
  double at(std::size_t frame, double fluctuation_there) const
  {
    if (frame >= difference.size() || !(fluctuation[frame] > 0.))
      return std::numeric_limits<double>::quiet_NaN();
    return difference[frame] / fluctuation[frame] * fluctuation_there;
  }
};

struct FineStep
{
  std::string why; ///< reason where it was not reached
  double seconds = 0.;
};

/// A full-resolution cloth. All ranks call all members.
class FineRun
{
public:
  virtual ~FineRun() = default;
  /// One step, or the equilibrium of a time.
  virtual FineStep advance(bool to_equilibrium, double step, double time) = 0;
  virtual void resume(const meshes::ClothState &state)                    = 0;
  virtual const meshes::SpacePoints &positions() const                    = 0;
  virtual meshes::SpacePoints velocities() const                          = 0;
  virtual double time() const                                             = 0;
  virtual double kinetic_energy() const                                   = 0;
  virtual double stored_energy() const                                    = 0;
  virtual int n_vertices() const                                          = 0;
  virtual unsigned long n_dofs() const                                    = 0;
};

/// By finite elements, on all ranks.
std::unique_ptr<FineRun> dealii_run(const DrapedCell &draped, Law law, unsigned int order,
                                    MPI_Comm communicator);

/// By the shell's own code, a stiffness per triangle; on the first rank, one thread.
std::unique_ptr<FineRun> shell_run(const DrapedCell &draped, MPI_Comm communicator);
} // namespace homespun::verification
