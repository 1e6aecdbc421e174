// SPDX-License-Identifier: MIT
// A method: a coarse cloth and what up-sampling adds to it, as a set of terms; and what up-sampling
// by it takes of a cell, the same for the coarse cloths of studies and for those of others.
#pragma once

#include "localization/options.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/law.h"

#include <set>
#include <string>
#include <vector>

namespace homespun::localization
{
using meshes::Law;

enum class Term
{
  p2,    ///< the coarse cloth has triangles of six nodes, with the same vertices
  edges, ///< slip, tension and layers of edges (meshes/plain/cell_edges.h); chi then has mean zero,
         ///< and is else anchored
  cubic, ///< the coarse cloth has the cell's cubic energy under the law
  modes, ///< beside chi: quadratic in strain, or fitted, as the law has them
  curved, ///< in space: the surface through the coarse vertices bends between them, and with micro
          ///< has the deflection of the bent cell (localization/coarse_surface.h)
  micro   ///< chi, and with it modes and layers of edges; without it the fine positions are the
          ///< coarse motion, interpolated
};

std::string name_of(Term term);

/// A preset, and terms that are added to it or taken from it: `preset([+-]term)*`.
/// - affine: no term; the baseline
/// - localized: micro; the paper's
/// - full: all of them, of which those count that have a meaning under a law and load
class Method
{
public:
  /// @param text like `localized+p2`, its terms in any order
  /// @throws BadInput naming the preset or term that is unknown, or there twice, or not there to be
  ///   taken away
  explicit Method(const std::string &text);

  /// Those of a study in the plane that asks for none: each preset, each of its terms beside
  /// `localized`, and the coarse cloths of `full`, against which up-sampling is judged.
  static const std::vector<std::string> &defaults();

  /// What a name of version 0.1 is called now; empty of any other.
  static std::string name_of_old(const std::string &text);

  /// As it was asked for, its terms in the order of the enumerators.
  std::string name;

  bool has(Term term) const
  {
    return terms.count(term) != 0;
  }

  /// How many terms up-sampling has; zero without micro.
  int rank() const
  {
    return has(Term::micro) ? static_cast<int>(terms.size()) : 0;
  }

  /// The same method without what has no meaning: in linear theory and under laws of yarns there is
  /// no cubic energy, in linear theory there are no modes.
  Method under(Law law) const;

  Method without(Term term) const;

  /// Whether a term is asked for by name, and not with a preset.
  bool asks_for(Term term) const;

  /// What the method is called without a term that it has.
  std::string name_without(Term term) const;

  /// The names of the presets.
  static std::vector<std::string> presets();

  /// The names of its terms.
  std::vector<std::string> term_names() const;

  /// What it has and another has not, as in `p2 and edges`; empty where that is nothing.
  std::string beyond(const Method &other) const;

  const std::set<Term> &own_terms() const
  {
    return terms;
  }

  bool has_terms_of(const Method &other) const
  {
    return terms == other.terms;
  }

  /// Whether modes are fitted to the strains of a study, which the method then has to be given.
  bool has_fitted_modes(Law law) const;

  /// Whether it takes the cell's second order under a law: its cubic energy or quadratic modes.
  bool is_of_second_order(Law law) const;

  /// Of up-sampling, except fitted modes and edges, which options_of() gives.
  UpsamplerOptions options(Law law) const;

private:
  std::set<Term> terms;
};

/// What is known of a cell, as far as a method asks for it.
struct CellModel
{
  const meshes::HomogenizedCell &cell;
  const meshes::CellEdges *edges = nullptr; ///< what it does at edges
  /// Modes under a law; slip and layers of clamped edges follow their effective strain, layers of
  /// free ones meshes::strain_of_free_edges(), tension and forces within the strain itself. Null:
  /// all do.
  const meshes::FittedModes *fitted = nullptr;
};

/// What up-sampling by a method takes.
/// @param method as it is used
/// @param cell to be kept by the caller until an up-sampler is made
/// @param kinds of the edges of a sheet, which count where the method has terms of them
/// @throws BadInput where the cell lacks edges or fitted modes that the method asks for
UpsamplerOptions options_of(const Method &method, Law law, const CellModel &cell,
                            const EdgeKinds &kinds = {});
} // namespace homespun::localization
