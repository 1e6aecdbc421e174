// SPDX-License-Identifier: MIT
// The choices of localization (localization/README.md), each with what it means. The defaults are
// the method; the others are there so that a report can show what each choice costs.
#pragma once

#include "meshes/plain/cell_edges.h"
#include "meshes/plain/fitted_modes.h"

#include <Eigen/Core>

#include <array>
#include <string>

namespace homespun::localization
{
/// Positions of vertices, one per row, shape (n,dim) [m].
template <int dim>
using Positions = Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor>;

/// The same where they lie, row after row, whoever owns them.
template <int dim>
using PositionsOf = Eigen::Map<const Positions<dim>>;

/// Macro strain of a coarse triangle, Voigt (E11, E22, gamma12 = 2 E12) in the sheet's rest frame.
enum class Strain
{
  biot,  ///< U − I, U = sqrt(F^T F): the measure of the solver and of the `biot` reference
  linear ///< sym(F − I), dim = 2 only; implies the lift `identity`
};

/// How a fluctuation in the rest plane becomes a displacement of the current cloth.
enum class Lift
{
  rotation, ///< R = F U^-1, the tangential rotation: what linear theory gives
  affine,   ///< F, what paper Eq. 12 prints
  identity  ///< none, the columns of the unit matrix
};

/// Which constant chi carries.
enum class Anchor
{
  lattice, ///< zero at the lattice points, so that these stay on the coarse mesh (paper Eq. 12)
  mean     ///< mean zero over the cell
};

/// How strain and lift vary over the coarse mesh.
enum class Blend
{
  continuous, ///< averaged to the coarse vertices (weighted by rest area), linear in between
  piecewise   ///< constant in each coarse triangle: jumps across its edges
};

/// Which way through the data.
enum class Path
{
  automatic, ///< the aligned one where the coarse mesh is the sheet's own lattice, else the general
  general    ///< with point location, on any coarse mesh
};

/// What an edge of a sheet is to the modes that decay from it.
enum class EdgeKind
{
  none,    ///< without modes
  clamped, ///< held along its whole length
  free
};

/// What each of the four edges of a sheet is, numbered as in meshes::CellEdges.
using EdgeKinds = std::array<EdgeKind, meshes::CellEdges::n_sides>;

/// Whose coarse positions have the slip of clamped edges, which act d E off where they are held.
enum class Slip
{
  of_cloth, ///< the coarse cloth's, as where it moves by the terms of edges
  added     ///< nobody's: its edges lie where they are held, and up-sampling adds the slip
};

/// What lies between the coarse vertices of a cloth in space. In the plane all is flat.
enum class Surface
{
  flat,  ///< the coarse triangles themselves
  curved ///< what bends with the cloth (coarse_surface.h), and w3 of the bent cell where
         ///< microscopic
};

struct UpsamplerOptions
{
  bool microscopic = true; ///< false: the coarse motion interpolated, the baseline `affine`
  Strain strain    = Strain::biot;
  Lift lift        = Lift::rotation;
  Anchor anchor    = Anchor::lattice;
  Blend blend      = Blend::continuous;
  Path path        = Path::automatic;
  Surface surface  = Surface::flat;
  /// Law of the phases (`biot`, `green`) whose quadratic modes are added to chi, for errors of
  /// third order in strain: HomogenizedCell::second_order. Empty: none.
  std::string second_order;
  /// Modes of the cell that are added to chi, fitted over a box of strains. Null: none. Read by the
  /// constructor alone; not with second_order, with Blend::continuous.
  const meshes::FittedModes *fitted = nullptr;
  /// What the cell does at edges on lattice lines: modes that decay from them are added. Null:
  /// none. Read by the constructor alone; with Anchor::mean, which panels without such edges leave.
  const meshes::CellEdges *edges = nullptr;
  EdgeKinds edge_kinds           = {};
  Slip slip                      = Slip::of_cloth;
  /// Of a garment: over which distance from a seam the fluctuation grows from zero to its full
  /// size, in cell sides sqrt(|Y|), 0 to meshes::seam_reach. With 0 it does not fade, and seams
  /// gape.
  double seam_fade = 0.5;
};
} // namespace homespun::localization
