// SPDX-License-Identifier: MIT
#include "localization/given_method.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace homespun::localization
{
namespace
{
constexpr std::array<const char *, meshes::CellEdges::n_sides> names = {"left", "right", "bottom",
                                                                        "top"};

EdgeKinds kinds_of(const std::vector<std::string> &held)
{
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

/// Which edges of panels have layers, where some of the outlines have none; empty of a sheet.
std::string note_on_edges(const std::vector<Panel> &panels, const EdgeKinds &kinds)
{
  Panel all;
  for (const Panel &panel : panels)
  {
    all.length += panel.length;
    all.sewn_length += panel.sewn_length;
    all.edge_length += panel.edge_length;
  }
  std::string where, nowhere;
  for (std::size_t side = 0; side < names.size(); ++side)
  {
    std::string of;
    for (std::size_t p = 0; p < panels.size(); ++p)
      if (std::any_of(panels[p].edges.begin(), panels[p].edges.end(),
                      [&](const PanelEdge &edge) { return edge.side == static_cast<int>(side); }))
        of += (of.empty() ? "" : ", ") + std::to_string(p);
    const bool is_held = kinds[side] == EdgeKind::clamped;
    if (!of.empty())
      where += std::string(where.empty() ? "" : "; ") + names[side] +
               (is_held ? " (held)" : " (free)") + " of panel " + of;
    else if (is_held)
      nowhere += std::string("; no edge on a lattice line is `") + names[side] + "`, which is held";
  }
  const double n_percent = 100. / all.length, off = all.length - all.sewn_length - all.edge_length;
  if (panels.empty() || (nowhere.empty() && off + all.sewn_length <= 1e-9 * all.length))
    return "";
  return "edges have layers at " + where + "; none along the " +
         std::to_string(std::lround(n_percent * all.sewn_length)) +
         " % of the outlines that are sewn and the " +
         std::to_string(std::lround(n_percent * off)) + " % that lie on no lattice line" + nowhere;
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
    !given.panels.empty() && std::all_of(given.panels.begin(), given.panels.end(),
                                         [](const Panel &panel) { return panel.edges.empty(); })
      ? "no edge of a panel that is not sewn lies on a lattice line of its cells"
    : given.held.empty() ? "`held` does not say which edges on lattice lines are held: left, "
                           "right, bottom, top, or none"
                         : "";
  if (result.used.has(Term::edges))
  {
    std::string note = note_on_edges(given.panels, kinds);
    if (!why_no_edges.empty())
    {
      if (method.asks_for(Term::edges))
        throw meshes::BadInput("method " + method.name + ": there are no terms of edges, because " +
                               why_no_edges);
      result.used = result.used.without(Term::edges);
      note        = "edges are left out, because " + why_no_edges;
    }
    result.left_out += (result.left_out.empty() || note.empty() ? "" : "; ") + note;
  }
  if (result.used.has(Term::curved) && result.used.has(Term::micro) && !cell.bending &&
      !method.asks_for(Term::curved))
  {
    result.used = result.used.without(Term::curved);
    result.left_out += std::string(result.left_out.empty() ? "" : "; ") +
                       "curved is left out, because the cell has no deflection of a bent sheet";
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
