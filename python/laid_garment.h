// SPDX-License-Identifier: MIT
// A coarse cloth of any shape with cells laid over it.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/garment/fine_cloth.h"

#include <pybind11/pybind11.h>

namespace homespun::python
{
struct LaidGarment
{
  meshes::ClothMesh coarse;
  meshes::FineCloth fine;
  meshes::Triangles triangles; ///< sewn
};

/// The flat cloth of arrays, rest (n,2), triangles (m,3) and positions (n,3) or None.
/// @throws BadInput naming the argument
meshes::ClothMesh cloth_of(const pybind11::object &rest, const pybind11::object &triangles,
                           const pybind11::object &positions);
} // namespace homespun::python
