// SPDX-License-Identifier: MIT
#include "verification/record/blas.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <dlfcn.h>

namespace homespun::verification
{
namespace
{
/// A function of a library that may not be there. What links with any BLAS cannot name those of
/// one.
template <typename Function>
Function *function(const char *name)
{
  return reinterpret_cast<Function *>(dlsym(RTLD_DEFAULT, name));
}

/// The file that has a function, with the links of Debian's alternatives followed.
std::string file_with(const char *name)
{
  Dl_info info;
  void *const place = dlsym(RTLD_DEFAULT, name);
  if (place == nullptr || dladdr(place, &info) == 0)
    return "unknown";
  std::error_code fault;
  const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, fault);
  return fault ? info.dli_fname : file.string();
}
} // namespace

void load_blas()
{
  dlopen("libblas.so.3", RTLD_NOW | RTLD_GLOBAL);
}

Blas loaded_blas()
{
  const auto configuration = function<char *()>("openblas_get_config");
  const auto threads       = function<int()>("openblas_get_num_threads");
  if (configuration != nullptr && threads != nullptr)
    return {configuration(), threads()};
  const std::string file = file_with("dgemm_");
  // The reference implementation of Debian knows no threads.
  return {file, file.find("/blas/libblas.so") != std::string::npos ? 1 : 0};
}

void choose_blas_kernels()
{
  const auto core_name           = function<char *()>("openblas_get_corename");
  const auto end                 = function<void()>("gotoblas_dynamic_quit");
  const auto begin               = function<void()>("gotoblas_dynamic_init");
  constexpr const char *variable = "OPENBLAS_CORETYPE";
  if (core_name == nullptr || end == nullptr || begin == nullptr || std::getenv(variable) ||
      std::string(core_name()) != "Prescott")
    return;
  const char *better = nullptr;
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
    better = "SkylakeX";
  else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    better = "Haswell";
#endif
  if (better == nullptr)
    return;
  setenv(variable, better, 0);
  end();
  begin();
}

void limit_blas_threads()
{
  for (const char *variable : {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"})
    if (std::getenv(variable) != nullptr)
      return;
  if (const auto set_threads = function<void(int)>("openblas_set_num_threads"))
    set_threads(1);
}
} // namespace homespun::verification
