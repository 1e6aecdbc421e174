// SPDX-License-Identifier: MIT
#include "tests/refusal.h"
#include "verification/program/command_line.h"
#include "verification/record/checksum.h"
#include "verification/record/run_folder.h"
#include "verification/record/verdict.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>

#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

namespace homespun::verification
{
namespace
{
namespace fs = std::filesystem;

class Folders : public testing::Test
{
protected:
  void SetUp() override
  {
    base = testing::TempDir() + "homespun-runs-XXXXXX";
    ASSERT_NE(mkdtemp(base.data()), nullptr);
    path = base + "/run";
  }
  void TearDown() override
  {
    fs::remove_all(base);
  }

  static void write(const std::string &file, const std::string &content)
  {
    std::ofstream(file) << content;
  }
  static std::string text(const std::string &file)
  {
    std::ifstream input(file);
    return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  }

  /// Leaves a run with a table, and says that it took this long.
  void leave_run(const RunDescription &what, const double seconds, const bool finish = true) const
  {
    RunFolder run(path, what, Earlier::keep_work);
    write(path + "/strain.csv", "cell\nstripes\n");
    if (finish)
      run.finish();
    auto json       = nlohmann::ordered_json::parse(text(path + "/run.json"));
    json["seconds"] = seconds;
    write(path + "/run.json", json.dump());
  }

  /// What opening the folder is refused with; and nothing in it may have changed.
  std::string refused(const RunDescription &what, const Earlier earlier) const
  {
    std::map<std::string, std::string> before, after;
    const auto all = [&](std::map<std::string, std::string> &files)
    {
      for (const auto &entry : fs::recursive_directory_iterator(path))
        if (entry.is_regular_file())
          files[entry.path()] = text(entry.path());
    };
    all(before);
    const std::string said = tests::refusal([&]() { RunFolder run(path, what, earlier); });
    all(after);
    EXPECT_EQ(before, after);
    return said;
  }

  const RunDescription one = {"strain", {{"cells", "a"}, {"strains", {0.1}}}};
  const RunDescription two = {"strain", {{"cells", "b"}, {"strains", {0.1}}}};
  std::string base, path;
};

using exact_run_folder    = Folders;
using tripwire_run_folder = Folders;

TEST_F(exact_run_folder, the_same_run_is_taken_up)
{
  leave_run(one, 100.);
  for (const Earlier earlier : {Earlier::keep_work, Earlier::resume})
  {
    const RunFolder run(path, one, earlier);
    EXPECT_TRUE(run.is_taken_up());
    EXPECT_EQ(text(path + "/strain.csv"), "cell\nstripes\n");
    EXPECT_TRUE(run.notice().empty());
  }
}

TEST_F(exact_run_folder, a_short_run_is_replaced_with_one_line_and_nothing_of_it_stays)
{
  leave_run(one, 1.);
  const RunFolder run(path, two, Earlier::keep_work);
  EXPECT_FALSE(run.is_taken_up());
  EXPECT_NE(run.notice().find("cells"), std::string::npos);
  EXPECT_FALSE(fs::exists(path + "/strain.csv"));
}

TEST_F(tripwire_run_folder, ten_seconds_of_work_of_another_run_are_not_lost)
{
  leave_run(one, 3600.);
  const std::string said = refused(two, Earlier::keep_work);
  EXPECT_NE(said.find("cells"), std::string::npos);
  EXPECT_NE(said.find("60 min of work"), std::string::npos) << said;
  EXPECT_NE(said.find("--overwrite"), std::string::npos);
  EXPECT_NE(refused(two, Earlier::resume).find("--resume"), std::string::npos);
  const RunFolder run(path, two, Earlier::overwrite);
  EXPECT_FALSE(fs::exists(path + "/strain.csv"));
}

TEST_F(tripwire_run_folder, a_folder_that_a_process_writes_is_refused_and_free_when_that_dies)
{
  int started[2];
  ASSERT_EQ(pipe(started), 0);
  const pid_t child = fork();
  if (child == 0)
  {
    const RunFolder run(path, one, Earlier::keep_work);
    const char ready = 1;
    if (::write(started[1], &ready, 1) == 1)
      pause();
    _exit(0);
  }
  char ready = 0;
  ASSERT_EQ(read(started[0], &ready, 1), 1);
  EXPECT_NE(refused(one, Earlier::overwrite).find("another homespun is writing"),
            std::string::npos);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(RunFolder(path, one, Earlier::keep_work).is_taken_up());
}

TEST_F(tripwire_run_folder, what_no_run_wrote_is_not_touched)
{
  fs::create_directories(path);
  write(path + "/thesis.tex", "years of work");
  EXPECT_NE(refused(one, Earlier::overwrite).find("thesis.tex"), std::string::npos);
  fs::remove(path + "/thesis.tex");
  leave_run(one, 1.);
  write(path + "/notes.csv", "mine");
  EXPECT_NE(refused(two, Earlier::overwrite).find("notes.csv"), std::string::npos);
  EXPECT_TRUE(RunFolder(path, one, Earlier::keep_work).is_taken_up()); // it may stay with its run
}

TEST_F(tripwire_run_folder, results_that_were_changed_after_their_run_are_refused)
{
  leave_run(one, 100.);
  write(path + "/strain.csv", "cell\nothers\n");
  EXPECT_NE(refused(one, Earlier::keep_work).find("strain.csv: was changed"), std::string::npos);
}

TEST_F(tripwire_run_folder, runs_of_others_within_a_folder_stay)
{
  leave_run(one, 1.);
  fs::create_directories(path + "/strain");
  write(path + "/strain/run.json", "{}");
  write(path + "/strain/strain.csv", "hours of work\n");
  for (const Earlier earlier : {Earlier::keep_work, Earlier::overwrite})
    EXPECT_NE(refused(two, earlier).find("holds strain/run.json"), std::string::npos);
  EXPECT_TRUE(RunFolder(path, one, Earlier::keep_work).is_taken_up());
}

TEST_F(tripwire_run_folder, a_damaged_description_is_refused)
{
  leave_run(one, 1.);
  write(path + "/run.json", "{\"format_version\": 1");
  EXPECT_NE(refused(one, Earlier::keep_work).find("run.json: is damaged"), std::string::npos);
}

TEST_F(tripwire_run_folder, a_run_of_a_newer_format_is_refused_and_stays)
{
  leave_run(one, 1.);
  auto json = nlohmann::ordered_json::parse(text(path + "/run.json"));
  EXPECT_EQ(json.begin().key(), "format_version");
  for (const auto &[version, words] :
       {std::pair<nlohmann::ordered_json, std::string>(2, "run.json: found format_version 2; "
                                                          "expected at most 1: a newer homespun"),
        {"old", "run.json: found format_version \"old\"; expected a whole number from 0 to 1"}})
  {
    json["format_version"] = version;
    write(path + "/run.json", json.dump());
    for (const Earlier earlier : {Earlier::keep_work, Earlier::overwrite})
      EXPECT_NE(refused(one, earlier).find(words), std::string::npos) << refused(one, earlier);
    EXPECT_TRUE(fs::exists(path + "/strain.csv"));
  }
}

TEST_F(exact_run_folder, a_run_that_says_no_format_is_an_older_one)
{
  leave_run(one, 1.);
  auto json = nlohmann::ordered_json::parse(text(path + "/run.json"));
  json.erase("format_version");
  json["format"] = 1; // as it was called
  write(path + "/run.json", json.dump());
  EXPECT_TRUE(RunFolder(path, one, Earlier::keep_work).is_taken_up());
}

TEST_F(exact_run_folder, default_places_are_apart)
{
  EXPECT_EQ(default_folder("strain", {"dots"}), "out/dots/strain");
  EXPECT_EQ(default_folder("strain-quick", {"dots"}), "out/dots/strain-quick");
  EXPECT_EQ(default_folder("verify", {"a", "b"}), "out/a+b/verify");
  EXPECT_EQ(default_folder("strain", {"a", "b", "c", "d", "e"}), "out/a+b+c+2-more/strain");
  EXPECT_EQ(default_folder("stress-quick", {}), "out/stress-quick");
}

TEST(exact_exit_status, the_worst_wins)
{
  using namespace exit_status;
  const std::vector<int> worst_first = {program_fault, bad_input,  not_converged,
                                        claim_failed,  claim_open, good};
  for (std::size_t a = 0; a < worst_first.size(); ++a)
    for (std::size_t b = 0; b < worst_first.size(); ++b)
      EXPECT_EQ(worse(worst_first[a], worst_first[b]), worst_first[std::min(a, b)]);
  const Verdict held = {"", Outcome::pass, 0., ""}, open = {"", Outcome::inconclusive, 0., ""},
                failed = {"", Outcome::fail, 0., ""};
  EXPECT_EQ(status_of({}), good);
  EXPECT_EQ(status_of({held}), good);
  EXPECT_EQ(status_of({held, open}), claim_open);
  EXPECT_EQ(status_of({open, failed, held}), claim_failed);
}

TEST(exact_exit_status, faults_of_homespun_itself_blame_nobody_else)
{
  const auto told_of = [](const Action &action, const int status)
  {
    testing::internal::CaptureStderr();
    EXPECT_EQ(guarded(action, true), status);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(
    told_of([]() -> int { throw meshes::BadInput("cell.prm: key"); }, exit_status::bad_input),
    "homespun: cell.prm: key\n");
  const std::string own = told_of([]() -> int { throw std::logic_error("/D is not symmetric"); },
                                  exit_status::program_fault);
  EXPECT_NE(own.find("a fault of homespun itself"), std::string::npos) << own;
  EXPECT_NE(own.find("/D is not symmetric"), std::string::npos) << own;
  EXPECT_NE(told_of([]() -> int { throw std::bad_alloc(); }, exit_status::bad_input).find("memory"),
            std::string::npos);
}
} // namespace
} // namespace homespun::verification
