// SPDX-License-Identifier: MIT
#include "verification/cell/cell_edges.h"

#include "homogenization/edges/edge_layers.h"
#include "homogenization/edges/plate_edges.h"
#include "meshes/plain/errors.h"
#include "verification/record/timing.h"

#include <cmath>
#include <cstdio>

namespace homespun::verification
{
namespace
{
template <typename Edges>
KnownBy<Edges> known_by(Edges (&edges_of)(const homogenization::UnitCell &,
                                          const homogenization::EdgeOptions &),
                        const homogenization::UnitCell &cell, const unsigned int order)
{
  KnownBy<Edges> known;
  homogenization::EdgeOptions options;
  options.order = order;
  known.seconds = seconds_of(
    [&]()
    {
      try
      {
        known.edges = edges_of(cell, options);
      }
      catch (const meshes::BadInput &refusal)
      {
        known.why_not = refusal.what();
      }
      catch (const meshes::NotConverged &failure)
      {
        known.why_not = failure.what();
      }
    });
  return known;
}
} // namespace

KnownEdges known_edges(const homogenization::UnitCell &cell, const unsigned int order)
{
  return known_by(homogenization::edges_of, cell, order);
}

KnownPlateEdges known_edges_of_plate(const homogenization::UnitCell &cell)
{
  return known_by(homogenization::edges_of_plate, cell, 2);
}

KnownEdges affordable_edges(const homogenization::UnitCell &cell, const unsigned int order)
{
  // Condensing a cell onto a side is a substitution per unknown of the side: measured, 36 s for
  // 132,098 unknowns of P1 with 514 on a side, both axes together.
  constexpr double most_seconds = 10., seconds_per_product = 5.3e-7;
  const double n_nodes  = cell.mesh.n_vertices() * (order == 2 ? 4. : 1.);
  const double estimate = seconds_per_product * 2. * n_nodes * 2. * std::sqrt(n_nodes);
  if (estimate <= most_seconds)
    return known_edges(cell, order);
  char text[160];
  std::snprintf(text, sizeof(text),
                "they would take about %.2g s on this mesh, more than %g: strain and drape make "
                "them where they need them",
                estimate, most_seconds);
  KnownEdges none;
  none.why_not = text;
  return none;
}
} // namespace homespun::verification
