#include "apps/common/cluster/slurm.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>

#include "apps/common/replace_all.h"
#include "apps/common/shell.h"
#include "framework/input/on_path.h"

namespace presa::slurm {
namespace {

std::string firstLineOf(const std::string& text) { return text.substr(0, text.find('\n')); }

/// "1-3,7": a list of all numbers would be too long for a command line.
std::string rangesOf(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i;
    while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) ++end;
    text += (text.empty() ? "" : ",") + std::to_string(numbers[i]);
    if (end > i) text += "-" + std::to_string(numbers[end]);
    i = end + 1;
  }
  return text;
}

/// In the names of output files % begins a pattern.
std::string plainPath(std::string path) {
  replaceAll(path, "%", "%%");
  return path;
}

bool isNumber(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::string trouble() {
  if (!input::isOnPath("sbatch")) return "sbatch is not on the PATH";
  const shell::Outcome ping = shell::run("sinfo --noheader --format=%P");
  return ping.status == 0 ? "" : "no Slurm controller answers: " + firstLineOf(ping.err);
}

std::string submit(const Array& array) {
  std::string command = "sbatch --parsable --open-mode=append --array=" + rangesOf(array.tasks) +
                        " --job-name=" + shell::quoted(array.name) +
                        " --output=" + shell::quoted(plainPath(array.log) + "%a.log");
  for (const std::string& option : array.options) command += " " + shell::quoted(option);
  const shell::Outcome told = shell::run(command + " " + shell::quoted(array.script));
  if (told.status != 0) throw std::runtime_error(firstLineOf(told.err));
  const std::string number = told.out.substr(0, told.out.find_first_of(";\n"));  // "12" or "12;cluster"
  if (!isNumber(number)) throw std::runtime_error("sbatch answers no job number: " + firstLineOf(told.out + told.err));
  return number;
}

std::optional<std::map<int, std::string>> tasksLeft(const std::string& number) {
  const shell::Outcome told = shell::run("squeue --noheader --array --jobs=" + number + " --format='%K %T'");
  std::map<int, std::string> left;
  if (told.err.find("Invalid job id") != std::string::npos) return left;  // forgotten: it has ended
  if (told.status != 0) return std::nullopt;
  std::istringstream lines(told.out);
  int task = 0;
  for (std::string state; lines >> task >> state;) left[task] = state;
  return left;
}

bool cancel(const std::string& number) { return shell::run("scancel " + number).status == 0; }

}  // namespace presa::slurm
