// SPDX-License-Identifier: MIT
#include "verification/strain/study_modes.h"

#include "meshes/files/cell_file.h"
#include "meshes/plain/errors.h"
#include "verification/method/method.h"
#include "verification/method/mode_fit.h"
#include "verification/record/number_text.h"

namespace homespun::verification
{
namespace
{
void keep(const std::map<Law, meshes::FittedModes> &modes, const std::string &cell_file)
{
  if (modes.empty())
    return;
  meshes::HomogenizedCell cell = meshes::read_cell(cell_file);
  for (const auto &[law, of_law] : modes)
    cell.fitted[name_of(law)] = of_law;
  meshes::write_cell(cell, cell_file);
}
} // namespace

std::map<Law, meshes::FittedModes> modes_of_study(const StrainStudyOptions &options,
                                                  const homogenization::UnitCell &cell,
                                                  const meshes::HomogenizedCell &homogenized,
                                                  StrainOutput &output)
{
  std::map<Law, meshes::FittedModes> all;
  for (const std::string &name : options.methods)
    for (const std::string &reference : options.references)
    {
      const Law law = law_of(reference);
      if (!Method(name).has_fitted_modes(law) || all.count(law) != 0)
        continue;
      const double strain     = options.strains.back();
      const StrainLevel level = {cell.name, options.loads.front(), law, strain};
      const StrainBox box     = box_up_to(strain, law);
      try
      {
        const ModeFit fit =
          fit_modes(NonlinearCell(homogenized, cell.stiffness_of_phase(), law), homogenized, box);
        all[law] = fit.modes;
        output.write_note(
          level, "method " + name + ": " + std::to_string(meshes::FittedModes::n_modes) +
                   " modes beside chi, fitted at " + std::to_string(fit.n_fitted) +
                   " strains of the box from " + short_text(box.low(0)) + " to " +
                   short_text(box.high(0)) + " along either axis and " + short_text(box.high(2)) +
                   " in shear; at " + std::to_string(fit.n_held_out) + " others they leave " +
                   short_text(100. * fit.left) + " % of the fluctuation, chi alone " +
                   short_text(100. * fit.left_by_chi) + " %");
      }
      catch (const meshes::NotConverged &failure)
      {
        output.write_note(level, "method " + name + ": " + failure.what());
      }
    }
  keep(all, options.output + "/" + cell.name + "/cell.h5");
  return all;
}
} // namespace homespun::verification
