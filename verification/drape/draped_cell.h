// SPDX-License-Identifier: MIT
// One cell in one scene: the coarse cloth with its effective material, the fine cloth with its
// phases, and the ways between them.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/files/surface_files.h"
#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/sheet.h"
#include "verification/drape/cloth_upsampler.h"
#include "verification/drape/scene_cloth.h"
#include "verification/law/laws.h"
#include "verification/method/coarse_parts.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
using Upsampler3f = ClothUpsampler<float>;
using Upsampler3d = ClothUpsampler<double>;

/// The terms of which a scene may have no use.
constexpr std::array<Term, 5> terms_of_scenes = {Term::p2, Term::edges, Term::cubic, Term::modes,
                                                 Term::curved};

/// Why a scene has no use for a term under a law of the coarse cloth, a clause behind its name;
/// empty where it has. Without a law, under any.
std::string why_not(Term term, const Scene &scene, std::optional<Law> law = {});

/// A method as a scene has it: without the terms that it has no use for.
Method used_in(const Scene &scene, const Method &method, std::optional<Law> law = {});

/// Whether a method, as it is used, moves a coarse cloth of its own: one with terms of edges, a
/// cubic energy or six-node triangles. The cloth has the name of the method, beside the variants of
/// the membrane.
bool has_own_cloth(const Method &used);

/// The scene on a smaller or larger sheet: translations of handles go with its size, held vertices
/// are those at the same places. A garment has no cells per side and stays as it is.
/// @throws BadInput where a held vertex is none of the other sheet, or of the given one
Scene scaled(const Scene &scene, int n_cells);

/// The coarse cloth of a scene where it begins, and where it is held.
struct CoarseStart
{
  /// @throws BadInput where the mesh of the scene or the cell cannot be used
  CoarseStart(const Scene &scene, const homogenization::UnitCell &cell);

  HeldMotion motion(const Scene &scene) const;

  meshes::ClothMesh mesh;
  std::optional<SheetPlacement> placement;                ///< of a sheet
  Eigen::RowVector2d origin = Eigen::RowVector2d::Zero(); ///< of a sheet [m]
  Eigen::Matrix2d sides     = Eigen::Matrix2d::Zero();    ///< of a sheet, rows [m]
};

class DrapedCell
{
public:
  /// @param law of the coarse cloth that is the method
  /// @throws BadInput where the cloth of the scene or the cell cannot be used, the scene bends by
  ///   the cell's D^H and there is none, or the law is one of yarns and C^H has no axes
  DrapedCell(const Scene &scene, const homogenization::UnitCell &cell,
             const meshes::HomogenizedCell &homogenized, Law law,
             const std::optional<meshes::CellEdges> &edges = {});

  /// A method as it is used here: used_in() the scene, and without edges where the cell has none.
  /// @throws BadInput where a term that was asked for by name is not used
  Method used(const Method &method) const;

  /// The coarse cloth of a method.
  /// @throws BadInput where the cell lacks what it asks for
  ClothMaterial effective_of(const Method &method) const;

  HeldMotion coarse_motion() const;
  /// @throws BadInput where a held vertex of the coarse cloth is none of the fine one
  HeldMotion fine_motion() const;

  template <typename Scalar>
  ClothUpsampler<Scalar> upsampler(const Method &asked) const
  {
    if (!sheet)
      return {homogenized, coarse, *garment, used(asked).options(law)};
    const CoarseParts<3> parts = parts_of(asked);
    return {homogenized, parts.space, *sheet, parts.options};
  }

  /// Vertices that up-sampling gives.
  int n_fine() const;

  /// Triangles between those.
  meshes::Triangles fine_triangles() const;

  /// The phases of fine_triangles(), for pictures.
  const meshes::SurfaceData &fine_data() const
  {
    return data;
  }

  /// Positions at the vertices that up-sampling gives, from those of `fine`.
  meshes::SpacePoints at_fine_vertices(const meshes::SpacePoints &positions) const;

  const Scene scene;
  const homogenization::UnitCell cell;
  const meshes::HomogenizedCell homogenized;
  const std::optional<meshes::CellEdges> edges; ///< where a method asks for them
  const Law law;
  const double side; ///< sqrt(|Y|) [m]
  std::optional<meshes::Sheet> sheet;
  std::optional<meshes::FineCloth> garment;
  meshes::ClothMesh coarse, fine; ///< of `fine`, the vertices in space that the shell moves
  ClothMaterial effective, phases;
  int centre_vertex = 0, fine_centre_vertex = 0; ///< nearest to the middle of the cloth
  std::optional<SheetPlacement> placement;

  /// What the edges of the sheet are.
  EdgeKinds kinds_of_edges() const
  {
    return edge_kinds({scene.n1, scene.n2}, coarse_motion().vertices(coarse));
  }

private:
  /// Of a sheet.
  CoarseParts<3> parts_of(const Method &method) const;

  meshes::SurfaceData data;
  std::vector<int> space_vertex; ///< of a garment's fine vertex
  std::vector<int>
    fine_of_coarse; ///< vertex of `fine` at each of `coarse` of a garment, −1 where there is none
};
} // namespace homespun::verification
