// SPDX-License-Identifier: MIT
#include "homogenization/fem/periodic_constraints.h"

#include "meshes/plain/errors.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace homespun::homogenization
{
using dealii::types::global_dof_index;

namespace
{
meshes::Points points_of(const std::vector<Node> &nodes)
{
  meshes::Points points(static_cast<Eigen::Index>(nodes.size()), 2);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) = nodes[k].point;
  return points;
}

/// Nodes on the sides of the cell: their vertices, and with P2 the midpoints of their edges.
std::size_t n_side_nodes(const Discretization &discretization, const meshes::Lattice &lattice)
{
  const meshes::Sides sides = meshes::sides_of(discretization.mesh, lattice);
  return sides.vertices.size() + (discretization.order == 2 ? sides.edges.size() : 0);
}

std::string text_of(const Node &node, const global_dof_index dof)
{
  std::ostringstream text;
  text.precision(10);
  text << "DoF " << dof << " (component " << (dof == node.first_dof ? 1 : 2) << ") at ("
       << node.point << ") m";
  return text.str();
}

/// A fault of one rank ends all: others wait for it.
/// @param fault of this rank; empty: none
void throw_on_all_ranks(const std::string &fault, const MPI_Comm communicator)
{
  if (dealii::Utilities::MPI::max(fault.empty() ? 0 : 1, communicator) > 0)
    throw std::logic_error(
      fault.empty() ? "audit of the periodic constraints: another rank found a fault" : fault);
}
} // namespace

void make_periodic_constraints(const Discretization &discretization, const meshes::Lattice &lattice,
                               const Eigen::RowVector2d &anchor, const std::vector<Node> &nodes,
                               dealii::AffineConstraints<double> &constraints)
{
  const meshes::ImageClasses classes = meshes::match_images(points_of(nodes), lattice);
  const auto has_images              = [](const int size) { return size > 1; };
  const auto matched =
    static_cast<std::size_t>(std::count_if(classes.size.begin(), classes.size.end(), has_images));
  const std::size_t n_sides = n_side_nodes(discretization, lattice);
  if (n_sides == 0 || matched < n_sides)
    throw meshes::BadInput(std::to_string(n_sides - std::min(matched, n_sides)) + " of " +
                           std::to_string(n_sides) +
                           " nodes on the sides have no periodic image; `homespun check` names "
                           "them");

  dealii::IndexSet lines = discretization.locally_active;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (discretization.locally_active.is_element(nodes[k].first_dof))
    {
      const Node &master = nodes[static_cast<std::size_t>(classes.representative[k])];
      lines.add_index(master.first_dof);
      lines.add_index(master.second_dof);
    }
  lines.compress();
  constraints.clear();
  constraints.reinit(lines);
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    const Node &master = nodes[static_cast<std::size_t>(classes.representative[k])];
    if (master.first_dof == nodes[k].first_dof || !lines.is_element(nodes[k].first_dof))
      continue;
    constraints.add_line(nodes[k].first_dof);
    constraints.add_entry(nodes[k].first_dof, master.first_dof, 1.);
    constraints.add_line(nodes[k].second_dof);
    constraints.add_entry(nodes[k].second_dof, master.second_dof, 1.);
  }

  // The master of the anchor's class is fixed; its images follow.
  const double tolerance = meshes::image_tolerance * std::sqrt(lattice.area());
  bool found             = false;
  for (std::size_t k = 0; k < nodes.size() && !found; ++k)
    if ((nodes[k].point - anchor).norm() <= tolerance)
    {
      found              = true;
      const Node &master = nodes[static_cast<std::size_t>(classes.representative[k])];
      if (lines.is_element(master.first_dof))
      {
        constraints.add_line(master.first_dof);
        constraints.add_line(master.second_dof);
      }
    }
  if (!found)
    throw std::logic_error("the anchor is not a node of the outline");
  constraints.close();
}

ConstraintAudit audit_periodic_constraints(const Discretization &discretization,
                                           const meshes::Lattice &lattice,
                                           const Eigen::RowVector2d &anchor,
                                           const std::vector<Node> &nodes,
                                           const dealii::AffineConstraints<double> &constraints)
{
  std::unordered_map<global_dof_index, std::size_t> node_of;
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    node_of[nodes[k].first_dof]  = k;
    node_of[nodes[k].second_dof] = k;
  }
  const double tolerance = meshes::image_tolerance * std::sqrt(lattice.area());
  ConstraintAudit audit;
  // Nodes that are tied, or to which others are tied; on the owner's rank only; then of all ranks.
  std::vector<unsigned int> is_tied(nodes.size(), 0), is_master(nodes.size(), 0);
  const auto check_line = [&](const std::size_t k, const global_dof_index dof)
  {
    if (!constraints.is_constrained(dof))
      return;
    const auto *entries = constraints.get_constraint_entries(dof);
    if (entries->empty())
    {
      const double gap = lattice.shortest(nodes[k].point - anchor).norm();
      if (gap > tolerance)
        throw std::logic_error("audit of the periodic constraints: " + text_of(nodes[k], dof) +
                               " is fixed, but it is not an image of the anchor");
      is_tied[k] = 1;
      return;
    }
    if (entries->size() != 1 || (*entries)[0].second != 1. ||
        node_of.count((*entries)[0].first) == 0)
      throw std::logic_error("audit of the periodic constraints: " + text_of(nodes[k], dof) +
                             " is not tied to one node of the outline with factor one");
    const global_dof_index master_dof = (*entries)[0].first;
    const std::size_t m               = node_of[master_dof];
    const double gap                  = lattice.shortest(nodes[k].point - nodes[m].point).norm();
    const bool same_component = (dof == nodes[k].first_dof) == (master_dof == nodes[m].first_dof);
    if (gap > tolerance || !same_component)
      throw std::logic_error("audit of the periodic constraints: " + text_of(nodes[k], dof) +
                             " is tied to " + text_of(nodes[m], master_dof) +
                             ", which is not its lattice image");
    audit.largest_gap = std::max(audit.largest_gap, gap);
    is_tied[k]        = 1;
    is_master[m]      = 1;
    ++audit.n_constrained;
  };
  std::string fault;
  try
  {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (discretization.locally_owned.is_element(nodes[k].first_dof))
      {
        check_line(k, nodes[k].first_dof);
        check_line(k, nodes[k].second_dof);
        if (constraints.is_constrained(nodes[k].first_dof) !=
            constraints.is_constrained(nodes[k].second_dof))
          throw std::logic_error(
            "audit of the periodic constraints: " + text_of(nodes[k], nodes[k].first_dof) +
            ": only one of its components is tied");
      }
  }
  catch (const std::logic_error &found)
  {
    fault = found.what();
  }
  throw_on_all_ranks(fault, discretization.communicator);
  const auto sum = [&](const unsigned int value)
  { return dealii::Utilities::MPI::sum(value, discretization.communicator); };
  audit.n_constrained = sum(audit.n_constrained);
  audit.largest_gap   = dealii::Utilities::MPI::max(audit.largest_gap, discretization.communicator);
  dealii::Utilities::MPI::max(is_tied, discretization.communicator, is_tied);
  dealii::Utilities::MPI::max(is_master, discretization.communicator, is_master);

  std::size_t n_accounted = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    n_accounted += (is_tied[k] | is_master[k]);
  const std::size_t n_sides = n_side_nodes(discretization, lattice);
  if (n_accounted < n_sides)
    throw std::logic_error(
      "audit of the periodic constraints: " + std::to_string(n_sides - n_accounted) +
      " nodes on the sides are not tied to any image");
  return audit;
}
} // namespace homespun::homogenization
