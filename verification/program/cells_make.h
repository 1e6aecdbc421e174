// SPDX-License-Identifier: MIT
// Variants of the shipped cells: the parameters of a cell's Gmsh source, and a copy of the cell
// with some of them changed, meshed by Gmsh.
#pragma once

#include <string>
#include <vector>

namespace homespun::verification
{
/// A parameter of a .geo file: `name = { value, Min least, Max most, Name "Parameters/text" }` in
/// its DefineConstant.
struct CellParameter
{
  std::string name;
  double value, least, most;
  bool whole; ///< has `Step 1`: only whole numbers
  std::string text;
};

/// The parameters of a Gmsh source, in its order.
/// @throws BadInput where the file cannot be read or lists none
std::vector<CellParameter> cell_parameters(const std::string &geo_file);

/// `name (value; least to most)`, as messages and the list of cells have it.
std::string description(const CellParameter &parameter);

/// Which cell, and what to change in it.
struct CellVariant
{
  std::string cell;                  ///< name of a shipped cell
  std::vector<std::string> settings; ///< `key=value`
  std::string name;                  ///< of the files; empty: that of the cell
  std::string output = ".";          ///< folder, made where it is missing
};

/// Writes NAME.geo (whose defaults are the values asked for), NAME.msh (made from it by Gmsh) and
/// NAME.prm into the output folder. All three are written after the new cell has been found sound,
/// or none.
/// @return the .prm file
/// @throws BadInput with one message per fault: a cell or parameter that does not exist, a value
///   that is no number or out of range, files that exist already, Gmsh missing or failing, a cell
///   that is not sound
std::string make_cell(const CellVariant &variant);
} // namespace homespun::verification
