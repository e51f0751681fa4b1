#include "experiments/study/jobs.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

namespace presa {
namespace {

using Outcome = JobResult::Outcome;

TEST(Jobs, GiveTheirResultsByIndexWhateverTheOrderOfTheirEnds) {
  const auto results = runJobs(7,
                               [](std::size_t i) {
                                 std::this_thread::sleep_for(std::chrono::milliseconds(i == 0 ? 200 : 5));
                                 return std::string(100'000 * i, 'x') + std::to_string(i);  // more than a pipe holds
                               },
                               {.workers = 3});
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].outcome, Outcome::kDone);
    EXPECT_EQ(results[i].text, std::string(100'000 * i, 'x') + std::to_string(i));
  }
}

TEST(Jobs, ACrashAnExceptionAndALoopAreResultsAndNotTheEndOfTheOthers) {
  std::size_t told = 0;
  const auto results = runJobs(5,
                               [](std::size_t i) -> std::string {
                                 if (i == 1) throw std::runtime_error("no such thing");
                                 if (i == 2) ::raise(SIGKILL);
                                 if (i == 3) std::this_thread::sleep_for(std::chrono::hours(1));
                                 if (i == 4) ::_exit(7);
                                 return "fine";
                               },
                               {.workers = 5,
                                .time_limit = 1.0,
                                .stop = {},
                                .on_done = [&](std::size_t, const JobResult&) { ++told; },
                                .on_wait = {}});
  EXPECT_EQ(results[0].outcome, Outcome::kDone);
  EXPECT_EQ(results[1].outcome, Outcome::kThrew);
  EXPECT_EQ(results[1].text, "no such thing");
  EXPECT_EQ(results[2].outcome, Outcome::kCrashed);
  EXPECT_EQ(results[3].outcome, Outcome::kTimedOut);
  EXPECT_EQ(results[4].outcome, Outcome::kCrashed);
  EXPECT_EQ(results[4].text, "exit status 7");
  EXPECT_EQ(told, 5u);
}

TEST(Jobs, StopEndsWhatRunsAndStartsNoMore) {
  const auto results = runJobs(6,
                               [](std::size_t) {
                                 std::this_thread::sleep_for(std::chrono::hours(1));
                                 return std::string{};
                               },
                               {.workers = 2, .time_limit = 600, .stop = [] { return true; }});
  for (const JobResult& result : results) EXPECT_EQ(result.outcome, Outcome::kNotRun);
}

TEST(Jobs, EndWithTheProcessThatAskedForThem) {
  int lives[2];
  ASSERT_EQ(::pipe(lives), 0);  // its end is read when no process has it open any more
  const pid_t asker = ::fork();
  if (asker == 0) {
    ::close(lives[0]);
    runJobs(4,
            [](std::size_t) -> std::string {
              std::this_thread::sleep_for(std::chrono::hours(1));
              return {};
            },
            {.workers = 2});
    ::_exit(0);
  }
  ::close(lives[1]);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ::kill(asker, SIGKILL);
  char none;
  EXPECT_EQ(::read(lives[0], &none, 1), 0);  // waits for hours where jobs go on
  ::close(lives[0]);
  EXPECT_EQ(::waitpid(asker, nullptr, 0), asker);
}

TEST(Jobs, ThatCannotBeStartedAnyMoreAreAnError) {
  // the first job kills the process that starts the others
  EXPECT_THROW(runJobs(3,
                       [](std::size_t) -> std::string {
                         ::kill(::getppid(), SIGKILL);
                         return {};
                       },
                       {.workers = 1}),
               std::runtime_error);
}

}  // namespace
}  // namespace presa
