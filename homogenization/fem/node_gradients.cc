// SPDX-License-Identifier: MIT
#include "homogenization/fem/node_gradients.h"

#include "meshes/plain/triangle_kinematics.h"

namespace homespun::homogenization
{
using namespace dealii;

NodeGradients::NodeGradients(const Discretization &discretization, const Quadrature<2> &quadrature)
    : mesh(discretization.mesh)
    , weights(quadrature.get_weights())
{
  const FiniteElement<2> &shapes = discretization.element.base_element(0);
  for (const Point<2> &point : quadrature.get_points())
    for (unsigned int k = 0; k < shapes.n_dofs_per_cell(); ++k)
    {
      const Tensor<1, 2> gradient = shapes.shape_grad(k, point);
      on_reference.insert(on_reference.end(), {gradient[0], gradient[1]});
    }
}

void NodeGradients::reinit(const int triangle)
{
  const meshes::TriangleGeometry geometry = meshes::triangle_geometry(
    meshes::sides_of_triangle<2>(mesh.triangles.row(triangle), mesh.vertices));
  inverse_jacobian =
    geometry.shape_gradients.bottomRows<2>(); // of the coordinates on the reference
  area_of_triangle = geometry.area;
}
} // namespace homespun::homogenization
