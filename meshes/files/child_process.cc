// SPDX-License-Identifier: MIT
#include "meshes/files/child_process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace homespun::meshes
{
namespace
{
/// The variables that this program was begun with. MPI adds its own to those of a running program.
std::vector<std::string> initial_environment()
{
  std::ifstream input("/proc/self/environ");
  std::vector<std::string> variables;
  for (std::string variable; std::getline(input, variable, '\0');)
    variables.push_back(variable);
  return variables;
}

/// What mpirun gives a rank; what a user gives to allow root stays.
bool is_of_mpi(const std::string &variable)
{
  const auto begins_with = [&](const char *start) { return variable.rfind(start, 0) == 0; };
  return (begins_with("OMPI_") && !begins_with("OMPI_ALLOW_")) || begins_with("PMIX_") ||
         begins_with("PRTE_");
}

std::vector<char *> pointers_to(std::vector<std::string> &texts)
{
  std::vector<char *> pointers;
  for (std::string &text : texts)
    pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}
} // namespace

int run_child(const std::vector<std::string> &words, const std::string &log,
              const std::vector<std::string> &variables)
{
  std::vector<std::string> arguments = words, environment = initial_environment();
  const auto is_of_rank = [](const std::string &variable) {
    return variable.rfind("OMPI_COMM_WORLD_SIZE=", 0) == 0 || variable.rfind("PMIX_RANK=", 0) == 0;
  };
  if (std::any_of(environment.begin(), environment.end(), is_of_rank))
    environment.erase(std::remove_if(environment.begin(), environment.end(), is_of_mpi),
                      environment.end());
  environment.insert(environment.begin(), variables.begin(), variables.end());

  cpu_set_t own_cores, all_cores;
  const bool is_bound = sched_getaffinity(0, sizeof(own_cores), &own_cores) == 0;
  std::memset(&all_cores, 0xff, sizeof(all_cores));
  sched_setaffinity(0, sizeof(all_cores), &all_cores);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!log.empty())
  {
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  }
  pid_t child       = 0;
  const int spawned = posix_spawnp(&child, arguments[0].c_str(), &actions, nullptr,
                                   pointers_to(arguments).data(), pointers_to(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (is_bound)
    sched_setaffinity(0, sizeof(own_cores), &own_cores);
  if (spawned != 0)
    return 127;
  int status   = 0;
  pid_t waited = -1;
  do
    waited = waitpid(child, &status, 0);
  while (waited < 0 && errno == EINTR);
  if (waited != child)
    return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string text_of_signal(const int status)
{
  if (status <= 128 || status > 128 + 64)
    return {};
  return "it was killed by signal " + std::to_string(status - 128) +
         (status == 128 + SIGKILL ? ": is there enough memory?" : "");
}
} // namespace homespun::meshes
