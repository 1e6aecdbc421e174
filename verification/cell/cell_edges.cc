// SPDX-License-Identifier: MIT
#include "verification/cell/cell_edges.h"

#include "homogenization/edges/edge_layers.h"
#include "meshes/plain/errors.h"
#include "verification/record/timing.h"

namespace homespun::verification
{
KnownEdges known_edges(const homogenization::UnitCell &cell, const unsigned int order)
{
  KnownEdges known;
  homogenization::EdgeOptions options;
  options.order = order;
  known.seconds = seconds_of(
    [&]()
    {
      try
      {
        known.edges = homogenization::edges_of(cell, options);
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
} // namespace homespun::verification
