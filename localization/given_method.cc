// SPDX-License-Identifier: MIT
#include "localization/given_method.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <array>

namespace homespun::localization
{
namespace
{
EdgeKinds kinds_of(const std::vector<std::string> &held)
{
  constexpr std::array<const char *, meshes::CellEdges::n_sides> names = {"left", "right", "bottom",
                                                                          "top"};
  EdgeKinds kinds;
  kinds.fill(EdgeKind::free);
  for (const std::string &name : held)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
      kinds[static_cast<std::size_t>(found - names.begin())] = EdgeKind::clamped;
    else if (name != "none" || held.size() > 1)
      throw meshes::BadInput("held: found `" + name +
                             "`; expected edges of the sheet, left, right, bottom, top, or none "
                             "alone");
  }
  return kinds;
}
} // namespace

GivenMethod on_given(const Method &method, const meshes::HomogenizedCell &cell,
                     const GivenCloth &given)
{
  const EdgeKinds kinds = kinds_of(given.held);
  GivenMethod result    = {method.without(Term::p2).without(Term::cubic), Law::biot, "", {}};
  if (!result.used.has(Term::micro))
    for (const Term term : {Term::edges, Term::modes})
    {
      if (method.asks_for(term))
        throw meshes::BadInput("method " + method.name + ": up-sampling has " + name_of(term) +
                               " with micro alone; expected localized+" + name_of(term));
      result.used = result.used.without(term);
    }
  const bool has_p2 = method.has(Term::p2), has_cubic = method.has(Term::cubic);
  if (has_p2 || has_cubic)
    result.left_out = std::string(!has_cubic ? "p2 belongs"
                                  : has_p2   ? "p2 and cubic belong"
                                             : "cubic belongs") +
                      " to the coarse cloth, which is yours";
  const std::string why_no_edges =
    !given.is_sheet ? "the cloth is no sheet of whole cells, whose edges are lattice lines"
    : given.held.empty()
      ? "`held` does not say which edges of the sheet are held: left, right, bottom, top, or none"
      : "";
  if (result.used.has(Term::edges) && !why_no_edges.empty())
  {
    if (method.asks_for(Term::edges))
      throw meshes::BadInput("method " + method.name + ": there are no terms of edges, because " +
                             why_no_edges);
    result.used = result.used.without(Term::edges);
    result.left_out +=
      (result.left_out.empty() ? "" : "; ") + ("edges are left out, because " + why_no_edges);
  }
  if (!result.left_out.empty())
    result.left_out = "method " + method.name + ": " + result.left_out;

  CellModel model = {cell, cell.edges ? &*cell.edges : nullptr};
  for (const Law law : meshes::all_laws())
    if (const auto fitted = cell.fitted.find(meshes::name_of(law));
        model.fitted == nullptr && fitted != cell.fitted.end())
    {
      result.law   = law;
      model.fitted = &fitted->second;
    }
  result.options      = options_of(result.used, result.law, model, kinds);
  result.options.slip = given.slip;
  return result;
}
} // namespace homespun::localization
