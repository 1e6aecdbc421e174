// SPDX-License-Identifier: MIT
// The laws of a membrane, by name, and what the program has to know of each: the one list, from
// which messages, defaults and schema.json are made. A law has its energy, stress and tangent in
// verification/law/laws.h, and as a sheet in space in space_laws.h beside it; the coarse
// cloth has those that are marked so once more, in shell/membrane.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace homespun::meshes
{
/// linear: W = ½ e:C:e,            e = sym(F − I)
/// biot:   W = ½ (U−I):C:(U−I),    U = sqrt(F^T F)
/// green:  W = ½ E:C:E,            E = ½ (F^T F − I)  (St. Venant-Kirchhoff)
/// yarn:   W = ½ e:C:e,            e of the stretches of two yarns and their angle (yarn_law.h);
///         biot where C has no axes
enum class Law
{
  linear,
  biot,
  green,
  yarn
};

struct LawProperties
{
  const char *name;
  bool has_yarns;        ///< needs axes of yarns
  bool has_second_order; ///< cells have quadratic modes and a cubic energy under it
  /// The coarse cloth has it at finite strain, too: of several laws, claims, budget and pictures
  /// speak of the first that has this.
  bool is_of_coarse_cloth;
  bool is_of_space; ///< a sheet in space has it
};

/// In the order of the enumerators.
inline constexpr std::array<LawProperties, 4> law_table = {{
  {"linear", false, false, false, false},
  {"biot", false, true, true, true},
  {"green", false, true, false, true},
  {"yarn", true, false, true, true},
}};

constexpr const LawProperties &properties_of(const Law law)
{
  return law_table[static_cast<std::size_t>(law)];
}

/// Every law, in the order of the table.
const std::vector<Law> &all_laws();

using LawProperty = bool LawProperties::*;

/// The laws that have a property.
std::vector<Law> laws_with(LawProperty property);

std::string name_of(Law law);

/// @throws BadInput naming what to take in its place, where a law of that name was removed
void refuse_removed_law(const std::string &name);

/// @throws BadInput listing the names, where it is none of them, or one that was removed
Law law_of(const std::string &name);
} // namespace homespun::meshes
