// SPDX-License-Identifier: MIT
#include "homogenization/mesh_files/converted_mesh.h"

#include "homogenization/mesh_files/mesh_text.h"
#include "meshes/files/child_process.h"
#include "meshes/files/temporary_folder.h"
#include "meshes/plain/errors.h"

#include "convert_mesh_script.h"

#include <algorithm>
#include <filesystem>

namespace homespun::homogenization
{
namespace
{
/// What is wrong with a mesh that Python could not convert, from its status and what it printed.
std::string fault_of(const int status, const MeshText &said)
{
  const std::string python = HOMESPUN_PYTHON;
  if (status == 127)
    return python + " cannot be run; expected Debian's Python with meshio: apt-get install " +
           "python3-meshio, or save the mesh as .msh with Gmsh";
  if (const std::string killed = meshes::text_of_signal(status); !killed.empty())
    return "the program that converts it did not end (" + killed +
           "); expected a whole mesh: write it again, or save it as .msh with Gmsh";
  // The last line: above it stands what libraries print.
  std::string text = said.content.substr(0, said.content.find_last_not_of('\n') + 1);
  text.erase(0, text.rfind('\n') + 1);
  return text.empty() ? python + " ended with status " + std::to_string(status) : text;
}

std::string converted(const std::string &file)
{
  const meshes::TemporaryFolder folder(std::filesystem::temp_directory_path().string());
  const std::string msh = folder.path + "/converted.msh", log = folder.path + "/log";
  // -P: no module from the working folder; -B: no files beside the modules.
  const int status =
    meshes::run_child({HOMESPUN_PYTHON, "-P", "-B", "-c", convert_mesh_script, file, msh}, log);
  if (status != 0)
    throw meshes::BadInput(unreadable(file) + fault_of(status, MeshText(log)));
  return MeshText(msh).content;
}

/// The text of the first rank on all of them.
void share(std::string &text, const MPI_Comm communicator)
{
  unsigned long size = text.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, communicator);
  text.resize(size);
  constexpr unsigned long at_once = 1ul << 30; // MPI counts by int
  for (unsigned long from = 0; from < size; from += at_once)
    MPI_Bcast(text.data() + from, static_cast<int>(std::min(at_once, size - from)), MPI_CHAR, 0,
              communicator);
}
} // namespace

std::string converted_to_msh(const std::string &file, const MPI_Comm communicator)
{
  if (communicator == MPI_COMM_NULL)
    return converted(file);
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  std::string text, fault;
  if (rank == 0)
    try
    {
      text = converted(file);
    }
    catch (const std::exception &failure)
    {
      fault = failure.what();
    }
  share(fault, communicator);
  if (!fault.empty())
    throw meshes::BadInput(fault);
  share(text, communicator);
  return text;
}
} // namespace homespun::homogenization
