// Counts of visits: whole lines, whatever happens to the process, and nothing about the visitor.
#include "apps/temple/visit_counts.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "apps/common/file_text.h"
#include "tests/apps/temple/support.h"

namespace presa::temple {
namespace {

std::vector<std::string> linesOf(const std::string& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

const std::regex kLine(R"(\d{4}-\d\d-\d\d,(first|column|facade),(begun|finished|left),\d+)");

TEST(VisitCounts, HasALineForBeginAndEnd) {
  const std::string file = test::scratch("counts") + "/deep/visits.csv";
  VisitCounts counts(file, "first");
  counts.leave(1);  // nobody was there
  counts.touch(10);
  counts.touch(20);
  counts.finish(95.4);
  counts.finish(96);
  counts.touch(200);
  counts.leave(230);
  const std::vector<std::string> lines = linesOf(file);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], "day,task,what,seconds");
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_TRUE(std::regex_match(lines[i], kLine)) << lines[i];
  EXPECT_TRUE(lines[1].ends_with(",first,begun,0"));
  EXPECT_TRUE(lines[2].ends_with(",first,finished,85"));
  EXPECT_TRUE(lines[4].ends_with(",first,left,30"));
}

TEST(VisitCounts, WithoutAFileCountsNothing) {
  VisitCounts counts("", "first");
  counts.touch(1);
  counts.finish(2);
}

// Three processes append at once and are killed at some moment: no line is broken or mixed with another, and each
// process has at most one visit that has begun without an end.
TEST(VisitCounts, SurviveAKill) {
  const std::string file = test::scratch("killed") + "/visits.csv";
  std::vector<pid_t> children;
  for (const char* task : {"first", "column", "facade"}) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      VisitCounts counts(file, task);
      for (int i = 0;; ++i) {
        counts.touch(i);
        counts.finish(i + 60);
      }
    }
    children.push_back(child);
  }
  const auto written = [&] { return std::filesystem::exists(file) && std::filesystem::file_size(file) >= 4000; };
  for (int i = 0; i < 30'000 && !written(); ++i) usleep(1000);
  EXPECT_TRUE(written()) << "the processes wrote nothing in 30 s";
  for (const pid_t child : children) kill(child, SIGKILL);
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  const std::string text = contentsOf(file);
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '\n');
  std::map<std::string, int> open;
  int strange = 0;
  for (const std::string& line : linesOf(file)) {
    std::smatch parts;
    if (!std::regex_match(line, parts, kLine)) {
      ++strange;
      continue;
    }
    open[parts[1]] += parts[2] == "begun" ? 1 : -1;
  }
  EXPECT_EQ(strange, 1);  // the names of the columns
  for (const auto& [task, begun] : open) EXPECT_TRUE(begun == 0 || begun == 1) << task << " " << begun;
}

TEST(VisitCounts, AreShownByDayAndTask) {
  const std::string file = test::scratch("table") + "/visits.csv";
  std::ofstream(file) << "day,task,what,seconds\n2026-05-01,first,begun,0\n2026-05-01,first,finished,80\n"
                         "2026-05-01,first,begun,0\n2026-05-01,first,finished,101\n2026-05-01,column,begun,0\n"
                         "2026-05-01,column,left,20\n2026-05-02,first,begun,0\nrubbish\n";
  Diagnostics diagnostics;
  const std::string table = countsTable(file, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_NE(table.find("2026-05-01  first         2         2     0  91 s\n"), std::string::npos) << table;  // 90.5
  EXPECT_NE(table.find("2026-05-01  column        1         0     1  -\n"), std::string::npos) << table;
  EXPECT_NE(table.find("2026-05-02  first         1         0     0  -\n"), std::string::npos) << table;
  EXPECT_NE(table.find("1 lines are not understood"), std::string::npos) << table;
  countsTable(file + "x", diagnostics);
  EXPECT_NE(diagnostics.text().find("error[E964]"), std::string::npos);
}

}  // namespace
}  // namespace presa::temple
