// SPDX-License-Identifier: MIT
#include "verification/cell/study_inputs.h"

#include "homogenization/lint/cell_lint.h"
#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// FNV-1a over the numbers of a matrix, taken up from an earlier hash.
template <typename Matrix>
std::uint64_t hashed(std::uint64_t hash, const Matrix &matrix)
{
  const auto *bytes   = reinterpret_cast<const unsigned char *>(matrix.data());
  const std::size_t n = static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar);
  for (std::size_t k = 0; k < n; ++k)
    hash = (hash ^ bytes[k]) * 1099511628211u;
  return hash;
}

constexpr std::uint64_t start_of_hash = 14695981039346656037u;

std::string printed(const std::uint64_t hash)
{
  char text[20];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
  return text;
}
} // namespace

std::string fingerprint(const UnitCell &cell)
{
  std::uint64_t hash = start_of_hash;
  hash               = hashed(hash, cell.mesh.vertices);
  hash               = hashed(hash, cell.mesh.triangles);
  hash               = hashed(hash, cell.mesh.material);
  hash               = hashed(hash, cell.lattice.vectors);
  for (const homogenization::CurvedSide &side : cell.curved_sides)
    hash = hashed(hashed(hash, Eigen::Vector2i(side.a, side.b)), side.sagitta);
  for (const Eigen::Matrix3d &stiffness : cell.stiffness_of_phase())
    hash = hashed(hash, stiffness);
  for (const Eigen::Matrix3d &stiffness : cell.bending_stiffness_of_phase())
    hash = hashed(hash, stiffness); // layers of another order have the same c
  for (const homogenization::Phase &phase : cell.phases)
    hash = hashed(hash, Eigen::Vector2d(phase.thickness, phase.density));
  return printed(hash);
}

std::vector<std::string> notes_on_cells(const std::vector<UnitCell> &cells)
{
  std::vector<std::string> notes;
  for (const UnitCell &cell : cells)
  {
    if (cell.shift)
      notes.push_back(cell.name + ": " + homogenization::sentence_of(*cell.shift) + ".");
    const double side = std::sqrt(cell.lattice.area());
    if (!homogenization::lint_size(side, 1.).empty())
      notes.push_back(
        cell.name + ": a side of the cell is " + short_text(side) +
        " m, which no cloth has: is `Length unit` right? `homespun check` says more.");
  }
  return notes;
}

void check_names(const std::vector<UnitCell> &cells)
{
  for (std::size_t a = 0; a < cells.size(); ++a)
  {
    if (cells[a].name.find_first_of(",\"\n\r") != std::string::npos)
      throw meshes::BadInput(
        cells[a].file + ": the file's name holds a comma, a quote or a line break; expected none, "
                        "because it becomes a field of strain.csv: rename it");
    for (std::size_t b = 0; b < a; ++b)
      if (cells[a].name == cells[b].name)
        throw meshes::BadInput(cells[a].file + " and " + cells[b].file + " would both be called `" +
                               cells[a].name +
                               "` in the results; expected different file names: rename one");
  }
}

} // namespace homespun::verification
