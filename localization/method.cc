// SPDX-License-Identifier: MIT
#include "localization/method.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <array>
#include <utility>

namespace homespun::localization
{
namespace
{
using meshes::properties_of;
using Terms = std::set<Term>;

/// By the enumerators.
constexpr std::array<const char *, 6> term_names = {"p2",    "edges",  "cubic",
                                                    "modes", "curved", "micro"};

const Terms all_terms = {Term::p2,    Term::edges,  Term::cubic,
                         Term::modes, Term::curved, Term::micro};

const std::vector<std::pair<std::string, Terms>> all_presets = {{"affine", {}},
                                                                {"localized", {Term::micro}},
                                                                {"full", all_terms}};

/// Names of version 0.1, and what they are in this one.
constexpr std::array<std::pair<const char *, const char *>, 6> old_names = {
  {{"p2", "localized+p2"},
   {"edges", "localized+edges"},
   {"quadratic", "localized+cubic+modes"},
   {"fitted", "localized+modes"},
   {"first-order", "full-cubic-modes"},
   {"full-fitted", "full"}}};

[[noreturn]] void refuse(const std::string &text, const std::string &why)
{
  throw meshes::BadInput(
    "method `" + text + "`: " + why +
    "; expected affine, localized or full, with terms added or taken away, as in localized+p2 or "
    "full-micro; the terms are " +
    meshes::one_of({term_names.begin(), term_names.end()}));
}

const Terms &terms_of_preset(const std::string &text, const std::string &preset)
{
  for (const auto &[name, terms] : all_presets)
    if (preset == name)
      return terms;
  refuse(text, "no preset is called `" + preset + "`");
}

Term term_of(const std::string &text, const std::string &name)
{
  for (const Term term : all_terms)
    if (name == name_of(term))
      return term;
  refuse(text, "no term is called `" + name + "`");
}

/// What a text asks for.
struct Asked
{
  std::string preset;
  Terms added, taken;
};

Asked read(const std::string &text)
{
  std::size_t end = std::min(text.find_first_of("+-"), text.size());
  Asked asked     = {text.substr(0, end), {}, {}};
  const Terms &of = terms_of_preset(text, asked.preset);
  while (end < text.size())
  {
    const bool is_added     = text[end] == '+';
    const std::size_t begin = end + 1;
    end                     = std::min(text.find_first_of("+-", begin), text.size());
    const std::string name  = text.substr(begin, end - begin);
    const Term term         = term_of(text, name);
    if (asked.added.count(term) + asked.taken.count(term) != 0)
      refuse(text, "the term " + name + " is there twice");
    if (is_added == (of.count(term) != 0))
      refuse(text, asked.preset + (is_added ? " has the term " + name + " already"
                                            : " has no term " + name + " to take away"));
    (is_added ? asked.added : asked.taken).insert(term);
  }
  return asked;
}

Terms terms_of(const Asked &asked)
{
  Terms terms = terms_of_preset(asked.preset, asked.preset);
  terms.insert(asked.added.begin(), asked.added.end());
  for (const Term term : asked.taken)
    terms.erase(term);
  return terms;
}

std::string text_of(const Asked &asked)
{
  std::string name = asked.preset;
  for (const Term term : all_terms)
    if (asked.added.count(term) != 0)
      name += "+" + name_of(term);
    else if (asked.taken.count(term) != 0)
      name += "-" + name_of(term);
  return name;
}
} // namespace

std::string name_of(const Term term)
{
  return term_names[static_cast<std::size_t>(term)];
}

Method::Method(const std::string &text)
    : name(text_of(read(text)))
    , terms(terms_of(read(text)))
{
}

const std::vector<std::string> &Method::defaults()
{
  static const std::vector<std::string> all = {"affine",          "affine+p2",
                                               "localized",       "localized+p2",
                                               "localized+edges", "localized+cubic+modes",
                                               "full-micro",      "full"};
  return all;
}

std::string Method::name_of_old(const std::string &text)
{
  for (const auto &[old, name] : old_names)
    if (text == old)
      return name;
  return {};
}

Method Method::without(const Term term) const
{
  Method less = *this;
  less.terms.erase(term);
  return less;
}

Method Method::under(const Law law) const
{
  Method left = *this;
  if (!properties_of(law).has_second_order)
    left.terms.erase(Term::cubic);
  if (law == Law::linear)
    left.terms.erase(Term::modes);
  return left;
}

bool Method::asks_for(const Term term) const
{
  return name.find("+" + name_of(term)) != std::string::npos;
}

std::string Method::name_without(const Term term) const
{
  const std::string added = "+" + name_of(term);
  const std::size_t at    = name.find(added);
  return Method(at == std::string::npos ? name + "-" + name_of(term)
                                        : std::string(name).erase(at, added.size()))
    .name;
}

std::vector<std::string> Method::presets()
{
  std::vector<std::string> names;
  for (const auto &[name, terms] : all_presets)
    names.push_back(name);
  return names;
}

std::vector<std::string> Method::term_names() const
{
  std::vector<std::string> names;
  for (const Term term : terms)
    names.push_back(name_of(term));
  return names;
}

std::string Method::beyond(const Method &other) const
{
  Method more = *this;
  for (const Term term : other.terms)
    more.terms.erase(term);
  const std::vector<std::string> names = more.term_names();
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

bool Method::has_fitted_modes(const Law law) const
{
  return has(Term::modes) && properties_of(law).has_yarns;
}

bool Method::is_of_second_order(const Law law) const
{
  return (has(Term::cubic) || has(Term::modes)) && properties_of(law).has_second_order;
}

UpsamplerOptions Method::options(const Law law) const
{
  UpsamplerOptions options;
  options.microscopic = has(Term::micro);
  options.surface     = has(Term::curved) ? Surface::curved : Surface::flat;
  if (law == Law::linear)
  {
    options.strain = Strain::linear;
    options.lift   = Lift::identity;
  }
  if (has(Term::micro) && has(Term::modes) && properties_of(law).has_second_order)
    options.second_order = meshes::name_of(law);
  if (has(Term::micro) && has(Term::edges))
    options.anchor = Anchor::mean;
  return options;
}

UpsamplerOptions options_of(const Method &method, const Law law, const CellModel &cell,
                            const EdgeKinds &kinds)
{
  UpsamplerOptions options = method.options(law);
  const auto refuse_without =
    [&](const std::string &what, const Term term, const std::string &who_makes_it)
  {
    throw meshes::BadInput("method " + method.name + ": the cell has no " + what + ": " +
                           who_makes_it + ", or leave the term out, as in " +
                           method.name_without(term));
  };
  if (method.has(Term::micro) && method.has(Term::curved) && !cell.cell.bending)
    refuse_without("deflection of a bent sheet", Term::curved,
                   "make its cell.h5 again with `homespun homogenize`, with both stiffnesses");
  if (method.has(Term::micro) && method.has_fitted_modes(law))
  {
    if (cell.fitted == nullptr)
      refuse_without("modes fitted under the law `" + meshes::name_of(law) + "`", Term::modes,
                     "take the CELL/cell.h5 of `homespun strain`, which leaves them there");
    options.fitted = cell.fitted;
  }
  if (method.has(Term::micro) && method.has(Term::edges))
  {
    if (cell.edges == nullptr)
      refuse_without("terms of edges", Term::edges,
                     "make its cell.h5 again with `homespun homogenize`, or of a large mesh with "
                     "`homespun strain`");
    options.edges      = cell.edges;
    options.edge_kinds = kinds;
  }
  return options;
}
} // namespace homespun::localization
