// SPDX-License-Identifier: MIT
#include "verification/record/provenance.h"

#include "verification/build_info.h"
#include "verification/record/blas.h"
#include "verification/record/checksum.h"

#include <Eigen/Core>
#include <H5public.h>

#include <ctime>
#include <fstream>

#include <unistd.h>

namespace homespun::verification
{
namespace
{
std::string dotted(const int major, const int minor, const int patch)
{
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::string processor()
{
  std::ifstream input("/proc/cpuinfo");
  std::string line;
  while (std::getline(input, line))
    if (line.rfind("model name", 0) == 0)
      return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string present_date()
{
  const std::time_t seconds = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", std::gmtime(&seconds));
  return text;
}

/// The revision that a program was built from, with a checksum of the program where that is not
/// all.
std::string revision_of(const std::string &program)
{
  const std::string described = HOMESPUN_GIT_REVISION;
  const bool is_known         = described.find("dirty") == std::string::npos &&
                        described.find("no revision") == std::string::npos;
  return is_known ? described : described + "-" + checksum_of_file(program);
}

std::string host()
{
  char name[256] = "";
  gethostname(name, sizeof(name) - 1);
  return name;
}
} // namespace

std::string revision()
{
  static const std::string text = revision_of("/proc/self/exe");
  return text;
}

nlohmann::ordered_json provenance(const unsigned int n_ranks)
{
  const Blas blas = loaded_blas();
  return {{"homespun", HOMESPUN_VERSION},
          {"git", revision()},
          {"dealii", HOMESPUN_DEALII_VERSION},
          {"trilinos", HOMESPUN_TRILINOS_VERSION},
          {"hdf5", dotted(H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
          {"eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"compiler", std::string("GCC ") + __VERSION__},
          {"flags", HOMESPUN_BUILD_FLAGS},
          {"host", host()},
          {"processor", processor()},
          {"ranks", n_ranks},
          {"threads_per_rank", 1},
          {"blas", blas.library},
          {"blas_threads",
           blas.threads > 0 ? nlohmann::ordered_json(blas.threads) : nlohmann::ordered_json()},
          {"date", present_date()}};
}

std::string provenance_line()
{
  return std::string("homespun ") + HOMESPUN_VERSION + " (" + HOMESPUN_GIT_REVISION +
         "), deal.II " + HOMESPUN_DEALII_VERSION + ", " + present_date() + ", " + host();
}

std::string version_text(const std::string &program)
{
  nlohmann::ordered_json all = provenance(1);
  all["git"]                 = revision_of(program);
  std::string text;
  for (const char *key : {"homespun", "git", "dealii", "trilinos", "hdf5", "eigen"})
    text += std::string(key) + " " + all[key].get<std::string>() + "\n";
  const Blas blas = loaded_blas();
  text += "blas " + blas.library +
          (blas.threads == 1  ? ", 1 thread"
           : blas.threads > 1 ? ", " + std::to_string(blas.threads) + " threads"
                              : "") +
          "\n";
  return text + "CLI11 " + HOMESPUN_CLI11_VERSION + "\nnlohmann-json " +
         dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                NLOHMANN_JSON_VERSION_PATCH) +
         "\ncompiler " + all["compiler"].get<std::string>() + "\nflags " +
         all["flags"].get<std::string>() + "\n";
}
} // namespace homespun::verification
