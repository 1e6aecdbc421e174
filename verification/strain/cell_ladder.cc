// SPDX-License-Identifier: MIT
#include "verification/strain/cell_ladder.h"

#include "homogenization/fem/homogenize.h"
#include "localization/coarse_frames.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"
#include "verification/cell/cell_edges.h"
#include "verification/record/on_root.h"

#include <memory>

namespace homespun::verification
{
namespace
{
/// Slip and bulk term of edges, which belong to w of another mean, made those of up-sampling's w.
/// With w + c in place of w a clamped edge slips by d − c, and within u1 is less by c_a E_a(u0).
void centre_as_upsampling(const meshes::HomogenizedCell &cell, meshes::CellEdges &edges)
{
  const auto place = [&](const int v)
  { return cell.lattice.fractional(cell.mesh.vertices.row(v))(0); };
  int on_edge = 0; // on edge 0, where the fields are −w − d
  for (int v = 1; v < cell.mesh.n_vertices(); ++v)
    if (place(v) < place(on_edge))
      on_edge = v;
  const Eigen::RowVectorXd chi =
    localization::anchored(cell, localization::Anchor::mean).row(on_edge);
  Eigen::Matrix<double, 2, 3> constant;
  for (int a = 0; a < 3; ++a)
    for (int c = 0; c < 2; ++c)
      constant(c, a) =
        -chi(2 * a + c) + edges.sides[0].clamped(on_edge, 2 * a + c) + edges.sides[0].slip(c, a);
  for (meshes::CellEdge &side : edges.sides)
    side.slip -= constant;
  for (int b = 0; b < 2; ++b)
  {
    Eigen::Matrix<double, 2, 3> stress; // C^H e_c along axis b
    stress << cell.stiffness.row(b == 0 ? 0 : 2), cell.stiffness.row(b == 0 ? 2 : 1);
    const Eigen::Matrix3d more = constant.transpose() * stress;
    edges.bulk[static_cast<std::size_t>(b)] += more - more.transpose();
  }
}
} // namespace

CellLadder ladder_of(const homogenization::UnitCell &cell, const DiscretizedCell &p1,
                     const MPI_Comm communicator)
{
  CellLadder ladder = {p1, p1, p1};
  for (const unsigned int refine : {0U, 1U})
  {
    homogenization::HomogenizationOptions options;
    options.refine = refine;
    for (const Law law : meshes::laws_with(&meshes::LawProperties::has_second_order))
      if (p1.cell.second_order.count(name_of(law)) != 0)
        options.second_order.push_back(law);
    DiscretizedCell &finer = ladder[1 + refine];
    const auto solved      = homogenization::homogenize(cell, options, communicator);
    finer.cell             = homogenization::homogenized_cell(cell, solved, p1.cell.provenance);
    on_root(communicator,
            [&]()
            {
              if (!p1.edges)
                return;
              homogenization::UnitCell refined = cell;
              refined.mesh                     = meshes::refined(cell.mesh, refine);
              finer.edges                      = known_edges(refined, 2).edges;
              if (!finer.edges)
                return;
              // A row of refined cells has the vertices of the given ones in front of each.
              const int n = cell.mesh.n_vertices(), n_refined = refined.mesh.n_vertices();
              for (meshes::CellEdge &side : finer.edges->sides)
                for (meshes::EdgeModes *modes : {&side.clamped, &side.free})
                {
                  meshes::EdgeModes given(side.n_cells * n, 6);
                  for (int k = 0; k < side.n_cells; ++k)
                    given.middleRows(k * n, n) = modes->middleRows(k * n_refined, n);
                  *modes = given;
                }
              centre_as_upsampling(finer.cell, *finer.edges);
            });
  }
  return ladder;
}

std::function<const CellLadder &()> kept_ladder(const homogenization::UnitCell &cell,
                                                DiscretizedCell p1, const MPI_Comm communicator)
{
  return [&cell, p1 = std::move(p1), communicator,
          made = std::make_shared<std::optional<CellLadder>>()]() -> const CellLadder &
  {
    if (!*made)
      *made = ladder_of(cell, p1, communicator);
    return **made;
  };
}

MovedModel &MovedMethods::at(const Law law, const std::string &name)
{
  const auto known = moved.find({law, name});
  if (known != moved.end())
    return known->second;
  CellModel of        = cell;
  const Method method = Method(name).under(law);
  if (method.has_fitted_modes(law))
  {
    const auto its = fitted.find(law);
    if (its == fitted.end())
      throw meshes::NotConverged("no modes could be fitted under this law", {});
    of.fitted = &its->second;
  }
  return moved.try_emplace({law, name}, of, sheet, load, method, law).first->second;
}
} // namespace homespun::verification
