// SPDX-License-Identifier: MIT
// A method: a coarse cloth and what up-sampling adds to it, as a set of terms.
#pragma once

#include "localization/options.h"
#include "meshes/plain/law.h"
#include "verification/reference/loads.h"

#include <set>
#include <string>
#include <vector>

namespace homespun::verification
{
using meshes::Law;

enum class Term
{
  p2,    ///< the coarse cloth has triangles of six nodes, with the same vertices
  edges, ///< slip, tension and layers of edges (edge_terms.h); chi then has mean zero, and is else
         ///< anchored
  cubic, ///< the coarse cloth has the cell's cubic energy under the law
  modes, ///< beside chi: quadratic in strain, or fitted (mode_fit.h), as the law has them
  micro  ///< chi, and with it modes and layers of edges; without it the fine positions are the
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

  /// Those of a study that asks for none: each preset, each term beside `localized`, and the coarse
  /// cloths of `full`, against which up-sampling is judged (strain/gains.h).
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

  /// In an infinite cloth there are no edges, and the motion of the coarse cloth is given: without
  /// micro nothing but `affine` is left.
  Method under(Law law, const Load &load) const;

  Method without(Term term) const;

  /// Whether a term is asked for by name, and not with a preset.
  bool asks_for(Term term) const;

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

  /// Of up-sampling, but for fitted modes and edges, which it has to be given.
  localization::UpsamplerOptions options(Law law) const;

private:
  std::set<Term> terms;
};

/// The methods of a list that differ under a law and load: of those with the same terms the first,
/// presets in their own order before others.
/// @throws BadInput as Method
std::vector<std::string> distinct_methods(const std::vector<std::string> &names, Law law,
                                          const Load &load);

/// Those that have a meaning under one of several laws.
std::vector<std::string> distinct_methods(const std::vector<std::string> &names,
                                          const std::vector<Law> &laws, const Load &load);

/// The method of a list that claims, range of validity and pages speak of: the highest of rank, of
/// several the one whose terms come last; `localized` where none has micro.
std::string main_method(const std::vector<std::string> &names);

/// The same of the rows of one case that were reached.
/// @param rows with the columns `cell`, `load`, `reference` and `method`
template <typename Row>
std::string main_method(const std::vector<Row> &rows, const Row &of_case)
{
  std::vector<std::string> methods;
  for (const Row &row : rows)
    if (row.is_reached() && row.cell == of_case.cell && row.load == of_case.load &&
        row.reference == of_case.reference)
      methods.push_back(row.method);
  return main_method(methods);
}
} // namespace homespun::verification
