// SPDX-License-Identifier: MIT
// A disk that is full: the message, nothing left behind, and a program that ends with its own
// status.
#include "meshes/files/hdf5_writer.h"

#include "meshes/plain/errors.h"

#include <gtest/gtest.h>

#include <hdf5.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace homespun::meshes
{
namespace
{
/// Writes a file in a process of its own, in which no file may become larger than so many bytes.
/// @return 0 written; 2 refused as where the disk is full; 3 otherwise; −signal
int status_of_writing(const std::string &path, const unsigned long long most_bytes,
                      const unsigned long long n_numbers, const int n_datasets)
{
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {most_bytes, most_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    int status = 0;
    try
    {
      const std::vector<double> numbers(n_numbers, 1.5);
      Hdf5Writer file(path);
      for (int k = 0; k < n_datasets; ++k)
        file.write("/set" + std::to_string(k), {n_numbers}, numbers.data(), "m");
      file.finish();
    }
    catch (const BadInput &bad)
    {
      status = std::string(bad.what()) == path + ": cannot be written: is the disk full?" ? 2 : 3;
    }
    H5close(); // as MPI_Finalize does
    _exit(status);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}
} // namespace

TEST(tripwire_hdf5_writer, a_full_disk_is_told_and_the_program_ends_with_its_own_status)
{
  std::string folder = testing::TempDir() + "homespun-full-XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::string path = folder + "/a.h5";
  int n_written = 0, n_refused = 0;
  for (const unsigned long long most_bytes : {1000, 4096, 8192, 16384})
    for (const unsigned long long n_numbers : {10, 50, 80, 250, 1000})
      for (const int n_datasets : {1, 3, 8})
      {
        const int status = status_of_writing(path, most_bytes, n_numbers, n_datasets);
        EXPECT_TRUE(status == 0 || status == 2)
          << status << ": " << n_datasets << " times " << n_numbers << " in " << most_bytes;
        EXPECT_EQ(std::filesystem::exists(path), status == 0);
        EXPECT_FALSE(std::filesystem::exists(path + ".part"));
        n_written += status == 0;
        n_refused += status == 2;
        std::filesystem::remove(path);
      }
  EXPECT_GT(n_written, 10);
  EXPECT_GT(n_refused, 10);
  std::filesystem::remove_all(folder);
}
} // namespace homespun::meshes
