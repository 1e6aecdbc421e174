// SPDX-License-Identifier: MIT
// What a method and a law make of the coarse cloth of a sheet, at rest as in motion: the functions
// in which it moves, its cubic energy, the terms of its edges, and what up-sampling adds.
#pragma once

#include "localization/upsampler.h"
#include "meshes/plain/sheet.h"
#include "verification/method/coarse_space.h"
#include "verification/method/edge_terms.h"
#include "verification/method/method.h"

#include <optional>
#include <vector>

namespace homespun::verification
{
inline CoarseElement element_of(const Method &method)
{
  return method.has(Term::p2) ? CoarseElement::six_nodes : CoarseElement::three_nodes;
}

/// @tparam dim 2 of a sheet at rest in its plane, 3 of one that moves in space
template <int dim>
struct CoarseParts
{
  /// @param cell, sheet to be kept by the caller; the cell with the edges and fitted modes that the
  ///   method has
  /// @param method as it is used
  /// @param kinds of the edges, which count where the method has terms of them
  /// @param quads between the nodes; none: one per cell
  /// @throws BadInput where the cell lacks what the method asks for, or the sheet does not fit it
  CoarseParts(const CellModel &cell, const meshes::Sheet &sheet, const Method &method, Law law,
              const EdgeKinds &kinds, const std::optional<Quads> &quads = {});

  const CoarseSpace space;
  const std::vector<meshes::CubicForm> cubic; ///< none, or one
  std::optional<EdgeTerms<dim>> edges;
  localization::UpsamplerOptions options;
};
} // namespace homespun::verification
