// SPDX-License-Identifier: MIT
// The two sides of a comparison at one level: the resolved sheet, and the method.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/method/coarse_model.h"
#include "verification/method/fluctuation.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/reference_uncertainty.h"
#include "verification/strain/strain_output.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace homespun::verification
{
/// The resolved sheet at one level.
struct ResolvedLevel
{
  const meshes::Sheet &sheet;
  const ReferenceStep &fine;
  unsigned long n_dofs;
  unsigned int n_ranks;
  ReferenceBar bar; ///< of its positions [m] and of its force
  Stability stability;
  double seconds_stability;
  std::map<std::string, ErrorBar> error_bars = {}; ///< by method [m]

  /// @param has_left whether reference and bars are of two equilibria
  void forget_bars(const bool has_left)
  {
    if (!has_left)
      return;
    bar        = {unknown_length, unknown_length, unknown_length, unknown_length};
    error_bars = {};
  }
};

/// The methods on a sheet, and what their errors are measured by.
struct MethodsOnSheet : MovedMethods
{
  FluctuationMeasure fluctuation;
  const homogenization::UnitCell &resolved; ///< cell of the resolved sheet
  std::string why_no_edges = {};            ///< where the cell has none
};

/// A sheet under a load, with what holds the method against the reference there.
struct LoadedSheet
{
  const homogenization::UnitCell &cell;
  const Load &load;
  const ReferenceUncertainty &uncertainty;
  SheetReferences &references;
  MethodsOnSheet &methods;
  bool has_budget; ///< that can be measured
};
} // namespace homespun::verification
