// SPDX-License-Identifier: MIT
// A cell laid over the coarse cloth of another program's simulation, and the up-sampling of it.
#pragma once

#include "localization/given_method.h"
#include "localization/upsampler.h"
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/files/surface_files.h"
#include "meshes/garment/fine_cloth_options.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

#include <memory>
#include <string>

namespace homespun::verification
{
struct UpsampledCloth
{
  /// Lays the cell: where the coarse mesh is that of a sheet of whole cells, to 1e-6 of a cell side
  /// (the digits of usual files; in the order of meshes::coarse_sheet(), two triangles per cell or,
  /// as six-node triangles are read, eight), as that sheet, the fast way; else over the panels, cut
  /// along their outlines (meshes::fine_cloth()).
  /// @param rest the coarse cloth with its panels at rest
  /// @param grain how the cells lie on all panels
  /// @param given beside its panels, which are found out
  /// @throws BadInput where cell and cloth do not fit
  UpsampledCloth(const meshes::HomogenizedCell &cell, const meshes::ClothMesh &rest,
                 const meshes::Grain &grain,
                 const localization::Method &method = localization::Method("localized"),
                 localization::GivenCloth given     = {});

  localization::GivenMethod method; ///< its options are used up
  meshes::ClothMesh coarse;         ///< as given; the rest state of a sheet is that of whole cells
  std::string description;          ///< "a sheet of 20 x 20 cells"
  meshes::Triangles triangles;      ///< (k,3) between fine vertices
  meshes::ClothLook look;           ///< its phases, and texture by the rest coordinates
  Eigen::VectorXi coarse_triangle;  ///< the coarse triangle of each fine vertex
  std::unique_ptr<localization::Upsampler<3, float>> upsampler;
};
} // namespace homespun::verification
