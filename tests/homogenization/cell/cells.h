// SPDX-License-Identifier: MIT
// Unit cells made in code, and what theory says of them.
#pragma once

#include "homogenization/cell/laminate.h"
#include "homogenization/fem/homogenize.h"
#include "tests/meshes/plain/shapes.h"

#include <functional>

namespace homespun::tests
{
/// A cell of n1 x n2 x 2 triangles; the phase is chosen by the fractional coordinates of a square.
inline homogenization::UnitCell cell_of(const meshes::Lattice &lattice, const int n1, const int n2,
                                        const std::vector<homogenization::Phase> &phases,
                                        const std::function<int(double f1, double f2)> &phase_at)
{
  homogenization::UnitCell cell;
  cell.name    = "test";
  cell.lattice = lattice;
  cell.mesh    = parallelogram(lattice, n1, n2);
  cell.phases  = phases;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    cell.mesh.material(t) =
      phase_at((t / 2 % n1 + 0.5) / n1, (static_cast<double>(t / 2 / n1) + 0.5) / n2);
  return cell;
}

/// One phase.
inline int everywhere_the_same(double, double)
{
  return 0;
}

/// Soft and hard halves, stacked along axis 2.
inline int halves(double, const double f2)
{
  return f2 < 0.5 ? 0 : 1;
}

/// An inclusion of a quarter of the area.
inline int square_inclusion(const double f1, const double f2)
{
  return std::abs(f1 - 0.5) < 0.25 && std::abs(f2 - 0.5) < 0.25 ? 1 : 0;
}

inline std::vector<homogenization::Phase> soft_and_hard()
{
  return {homogenization::isotropic("soft", 1., 0.3, 1., 1.),
          homogenization::isotropic("hard", 10., 0.3, 1., 1.)};
}

inline homogenization::Homogenization solved(const homogenization::UnitCell &cell,
                                             const unsigned int order = 1)
{
  homogenization::HomogenizationOptions options;
  options.order     = order;
  options.tolerance = 1e-12;
  return homogenization::homogenize(cell, options, MPI_COMM_SELF);
}

/// The cell for up-sampling, solved as above.
inline meshes::HomogenizedCell homogenized(const homogenization::UnitCell &cell)
{
  return homogenization::homogenized_cell(cell, solved(cell), "test");
}

/// Largest difference of entries, relative to the largest entry.
inline double relative_difference(const Eigen::Matrix3d &a, const Eigen::Matrix3d &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}
} // namespace homespun::tests
