// SPDX-License-Identifier: MIT
#include "homogenization/fem/periodic_constraints.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
struct Periodic
{
  explicit Periodic(const unsigned int order)
      : lattice(tests::skewed_lattice())
      , discretization(tests::parallelogram(lattice, 4, 3), order, MPI_COMM_SELF)
      , nodes(discretization.boundary_nodes())
  {
    make_periodic_constraints(discretization, lattice, anchor, nodes, constraints);
  }

  ConstraintAudit audit(const dealii::AffineConstraints<double> &audited) const
  {
    return audit_periodic_constraints(discretization, lattice, anchor, nodes, audited);
  }

  /// The refusal of the audit, empty where it passes.
  std::string refusal(const dealii::AffineConstraints<double> &audited) const
  {
    try
    {
      audit(audited);
      return "";
    }
    catch (const std::logic_error &error)
    {
      return error.what();
    }
  }

  /// The same lines, but those of one DoF made anew by `plant`.
  template <typename Plant>
  dealii::AffineConstraints<double> with_bug(const dealii::types::global_dof_index bugged,
                                             Plant &&plant) const
  {
    dealii::AffineConstraints<double> copy;
    copy.reinit(discretization.locally_active);
    for (const auto &line : constraints.get_lines())
      if (line.index != bugged)
      {
        copy.add_line(line.index);
        for (const auto &entry : line.entries)
          copy.add_entry(line.index, entry.first, entry.second);
      }
    plant(copy);
    copy.close();
    return copy;
  }

  /// A node that is tied to another one.
  Node tied() const
  {
    for (const Node &node : nodes)
      if (constraints.is_constrained(node.first_dof) &&
          !constraints.get_constraint_entries(node.first_dof)->empty())
        return node;
    throw std::logic_error("no tied node");
  }

  const meshes::Lattice lattice;
  const Eigen::RowVector2d anchor = Eigen::RowVector2d::Zero();
  const Discretization discretization;
  const std::vector<Node> nodes;
  dealii::AffineConstraints<double> constraints;
};
} // namespace

TEST(exact_periodic_constraints, as_many_nodes_are_tied_as_counting_gives)
{
  for (const unsigned int order : {1u, 2u})
  {
    const Periodic periodic(order);
    const ConstraintAudit audit = periodic.audit(periodic.constraints);
    const unsigned int pairs    = 3 + 2 + (order == 2 ? 4 + 3 : 0);
    EXPECT_EQ(audit.n_constrained, 2 * pairs); // the corners are fixed, with the anchor
    EXPECT_LT(audit.largest_gap, 1e-15);
  }
}

TEST(tripwire_periodic_constraints, a_node_tied_to_the_wrong_node_is_caught)
{
  const Periodic periodic(1);
  const Node node                       = periodic.tied();
  dealii::types::global_dof_index other = 0;
  for (const Node &candidate : periodic.nodes)
    if (!periodic.constraints.is_constrained(candidate.first_dof) &&
        periodic.constraints.get_constraint_entries(node.first_dof)->front().first !=
          candidate.first_dof)
      other = candidate.first_dof;
  const auto bugged = periodic.with_bug(node.first_dof,
                                        [&](auto &constraints)
                                        {
                                          constraints.add_line(node.first_dof);
                                          constraints.add_entry(node.first_dof, other, 1.);
                                        });
  EXPECT_NE(periodic.refusal(bugged).find("not its lattice image"), std::string::npos);
}

TEST(tripwire_periodic_constraints, a_tie_between_different_components_is_caught)
{
  const Periodic periodic(1);
  const Node node   = periodic.tied();
  const auto master = periodic.constraints.get_constraint_entries(node.second_dof)->front().first;
  const auto bugged = periodic.with_bug(node.first_dof,
                                        [&](auto &constraints)
                                        {
                                          constraints.add_line(node.first_dof);
                                          constraints.add_entry(node.first_dof, master, 1.);
                                        });
  EXPECT_NE(periodic.refusal(bugged).find("not its lattice image"), std::string::npos);
}

TEST(tripwire_periodic_constraints, a_wrong_sign_is_caught)
{
  const Periodic periodic(2);
  const Node node   = periodic.tied();
  const auto master = periodic.constraints.get_constraint_entries(node.first_dof)->front().first;
  const auto bugged = periodic.with_bug(node.first_dof,
                                        [&](auto &constraints)
                                        {
                                          constraints.add_line(node.first_dof);
                                          constraints.add_entry(node.first_dof, master, -1.);
                                        });
  EXPECT_NE(periodic.refusal(bugged).find("with factor one"), std::string::npos);
}

TEST(tripwire_periodic_constraints, a_lost_pair_is_caught)
{
  const Periodic periodic(1);
  const Node node = periodic.tied();
  auto bugged     = periodic.with_bug(node.first_dof, [](auto &) {});
  // One component of the node is still tied; lose the other one as well.
  dealii::AffineConstraints<double> lost;
  lost.reinit(periodic.discretization.locally_active);
  for (const auto &line : bugged.get_lines())
    if (line.index != node.second_dof)
    {
      lost.add_line(line.index);
      for (const auto &entry : line.entries)
        lost.add_entry(line.index, entry.first, entry.second);
    }
  lost.close();
  EXPECT_NE(periodic.refusal(lost).find("not tied to any image"), std::string::npos);
  EXPECT_NE(periodic.refusal(bugged).find("only one of its components"), std::string::npos);
}

TEST(tripwire_periodic_constraints, dirichlet_conditions_instead_of_periodic_ones_are_caught)
{
  const Periodic periodic(1);
  dealii::AffineConstraints<double> clamped;
  clamped.reinit(periodic.discretization.locally_active);
  for (const Node &node : periodic.nodes)
  {
    clamped.add_line(node.first_dof);
    clamped.add_line(node.second_dof);
  }
  clamped.close();
  EXPECT_NE(periodic.refusal(clamped).find("not an image of the anchor"), std::string::npos);
}
