// SPDX-License-Identifier: MIT
#include "verification/program/mpi_start.h"

#include "meshes/files/temporary_folder.h"
#include "meshes/plain/errors.h"
#include "verification/program/command_line.h"
#include "verification/record/verdict.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include <sys/syscall.h>
#include <unistd.h>

namespace
{
/// While MPI starts: the folder of its session, empty where a launcher has it.
const std::string *session = nullptr;
} // namespace

/// Ends the process, as that of the C library, in whose place the libraries loaded take this one.
/// Open MPI 4 ends a process whose MPI_Init fails in no other way: it knows no error handler
/// before, and leaves out what std::atexit() was told.
extern "C" [[noreturn]] void _exit(int status)
{
  if (session != nullptr)
  {
    std::error_code ignored;
    if (!session->empty())
      std::filesystem::remove_all(*session, ignored);
    constexpr char text[] = "homespun: MPI did not start, for the reason above; expected Open MPI "
                            "as Debian has it: look at its settings, OMPI_MCA_* and "
                            "openmpi-mca-params.conf\n";
    if (write(STDERR_FILENO, text, sizeof(text) - 1) >= 0)
      status = homespun::verification::exit_status::not_converged;
  }
  for (;;)
    syscall(SYS_exit_group, status);
}

namespace homespun::verification
{
namespace
{
/// A variable of the environment that is another one for a while.
class Setting
{
public:
  Setting(const char *const variable, const std::string &value)
      : name(variable)
  {
    if (const char *const before = std::getenv(name))
      earlier = before;
    setenv(name, value.c_str(), 1);
  }
  Setting(const Setting &)            = delete;
  Setting &operator=(const Setting &) = delete;
  ~Setting()
  {
    if (earlier)
      setenv(name, earlier->c_str(), 1);
    else
      unsetenv(name);
  }

private:
  const char *name;
  std::optional<std::string> earlier;
};

/// Signals that wait as long as this lives, so that Ctrl-C leaves no folder.
class SignalsWait
{
public:
  SignalsWait()
  {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &earlier);
  }
  SignalsWait(const SignalsWait &)            = delete;
  SignalsWait &operator=(const SignalsWait &) = delete;
  ~SignalsWait()
  {
    sigprocmask(SIG_SETMASK, &earlier, nullptr);
  }

private:
  sigset_t earlier{};
};

/// A folder in that for temporary files.
std::optional<meshes::TemporaryFolder> new_folder()
{
  try
  {
    return std::optional<meshes::TemporaryFolder>(std::in_place,
                                                  std::filesystem::temp_directory_path().string());
  }
  catch (const std::filesystem::filesystem_error &error)
  {
    throw meshes::NotConverged(std::string("MPI did not start: ") + error.what() +
                                 "; expected a folder for temporary files: choose another TMPDIR",
                               {});
  }
  catch (const meshes::BadInput &error)
  {
    throw meshes::NotConverged(std::string("MPI did not start: ") + error.what(), {});
  }
}
} // namespace

void Mpi::start(char *const name)
{
  if (running)
    return;
  arguments[0]        = name;
  const auto initiate = [this](const std::string &folder)
  {
    session = &folder;
    running.emplace(n_arguments, first_argument, 1);
    session = nullptr;
  };
  if (is_launched())
    return initiate("");
  // A process by itself needs no daemon of Open MPI, whose start takes longer than all else in
  // MPI_Init; only processes that start others by MPI do.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  // Nor a network: looking for those of clusters takes as long as all that is left.
  setenv("OMPI_MCA_pml", "ob1", 0);
  // Without the daemon, who numbers the jobs, each process is job 0 and makes and removes the same
  // folder of a session as all others. With a folder of its own it is in nobody's way; once it runs
  // it needs none, for it has no other rank to share memory with, so that the folder goes at once
  // and no end of the process leaves it behind.
  const SignalsWait waiting;
  const auto folder = new_folder();
  const Setting place("TMPDIR", folder->path);
  initiate(folder->path);
}
} // namespace homespun::verification
