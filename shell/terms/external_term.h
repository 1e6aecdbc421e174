// SPDX-License-Identifier: MIT
// What terms share that press on the vertices from outside, wind and contact: they couple no two
// vertices, store no energy and may bring some into the cloth.
#pragma once

#include "shell/terms/term.h"

#include <vector>

namespace homespun::shell
{
/// A term with one block per vertex, on the diagonal.
class ExternalTerm : public Term
{
public:
  void attach(const BlockMatrix &matrix) override
  {
    places.clear();
    for (int v = 0; v < matrix.n_vertices(); ++v)
      places.push_back(matrix.slot(v, v));
  }

  double stored_energy(const Vectors &) const override
  {
    return 0.;
  }
  bool does_work() const override
  {
    return true;
  }
  bool is_internal() const override
  {
    return false;
  }

protected:
  std::vector<BlockMatrix::Slot> places; ///< (n) of each vertex
};
} // namespace homespun::shell
