#include "apps/temple/visit_counts.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <sstream>
#include <system_error>
#include <vector>

#include "framework/input/input.h"

namespace presa::temple {
namespace {

constexpr const char* kColumns = "day,task,what,seconds\n";
constexpr std::uint64_t kMaxCountsBytes = std::uint64_t{1} << 28U;  // a million visits

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 16> text;
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &local);
  return text.data();
}

struct Counted {
  int begun = 0, left = 0;
  std::vector<double> finished;  // [s]
};

/// False for a line that is not understood.
bool count(const std::string& line, std::map<std::pair<std::string, std::string>, Counted>& table) {
  std::istringstream in(line);
  std::string day, task, what, seconds;
  if (!std::getline(in, day, ',') || !std::getline(in, task, ',') || !std::getline(in, what, ',') || !(in >> seconds))
    return false;
  if (what != "begun" && what != "left" && what != "finished") return false;
  Counted& counted = table[{day, task}];
  if (what == "begun") ++counted.begun;
  if (what == "left") ++counted.left;
  if (what == "finished") counted.finished.push_back(std::atof(seconds.c_str()));
  return true;
}

std::string medianText(std::vector<double> seconds) {
  if (seconds.empty()) return "-";
  std::ranges::sort(seconds);
  const std::size_t half = seconds.size() / 2;
  const double median = seconds.size() % 2 == 1 ? seconds[half] : (seconds[half - 1] + seconds[half]) / 2;
  return std::to_string(std::lround(median)) + " s";
}

}  // namespace

VisitCounts::VisitCounts(std::string file, std::string task) : file_(std::move(file)), task_(std::move(task)) {
  if (file_.empty()) return;
  if (const auto folder = std::filesystem::path(file_).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder);
  const int made = open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (made < 0 && errno != EEXIST) throw std::system_error(errno, std::generic_category(), file_);
  if (made < 0) return;
  const auto length = static_cast<ssize_t>(std::string(kColumns).size());
  const bool written = write(made, kColumns, static_cast<std::size_t>(length)) == length;
  close(made);
  if (!written) throw std::system_error(errno, std::generic_category(), file_);
}

void VisitCounts::touch(double time) {
  if (since_ || file_.empty()) return;
  since_ = time;
  append("begun", 0);
}

void VisitCounts::end(const char* what, double time) {
  if (!since_) return;
  append(what, time - *since_);
  since_.reset();
}

// A full disk is no reason to end a visit: the line is then missing.
void VisitCounts::append(const char* what, double seconds) const {
  std::array<char, 160> line;
  const int length = std::snprintf(line.data(), line.size(), "%s,%s,%s,%.0f\n", today().c_str(), task_.c_str(), what,
                                   std::max(0.0, seconds));
  const int file = open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return;
  if (write(file, line.data(), static_cast<std::size_t>(length)) == length) fdatasync(file);
  close(file);
}

std::string defaultCountsFile() {
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path base = data != nullptr && *data != '\0' ? std::filesystem::path(data)
                                     : home != nullptr                ? std::filesystem::path(home) / ".local/share"
                                                                      : std::filesystem::temp_directory_path();
  return (base / "presa" / "temple" / "visits.csv").string();
}

std::string countsTable(const std::string& file, Diagnostics& diagnostics) {
  input::Refusal refusal;
  const auto text = input::read(file, kMaxCountsBytes, refusal);
  if (!text) {
    diagnostics.error(964, {file, 0, 0}, "the counts of visits " + refusal.what,
                      "a file that presa temple --counts wrote; visitors have to come first");
    return {};
  }
  std::map<std::pair<std::string, std::string>, Counted> table;
  std::istringstream lines(*text);
  int strange = 0;
  for (std::string line; std::getline(lines, line);)
    if (line + "\n" != kColumns && !count(line, table)) ++strange;
  std::string shown = "day         task      begun  finished  left  median time\n";
  for (const auto& [key, counted] : table) {
    std::array<char, 160> row;
    std::snprintf(row.data(), row.size(), "%-10.10s  %-8.8s  %5d  %8zu  %4d  %s\n", key.first.c_str(),
                  key.second.c_str(), counted.begun, counted.finished.size(), counted.left,
                  medianText(counted.finished).c_str());
    shown += row.data();
  }
  if (strange > 0) shown += std::to_string(strange) + " lines are not understood\n";
  return shown;
}

}  // namespace presa::temple
