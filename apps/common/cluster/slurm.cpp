#include "apps/common/cluster/slurm.h"

#include <sstream>
#include <stdexcept>

#include "apps/common/shell.h"
#include "framework/input/on_path.h"

namespace presa::slurm {
namespace {

std::string firstLineOf(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string trouble() {
  if (!input::isOnPath("sbatch")) return "sbatch is not on the PATH";
  const shell::Outcome ping = shell::run("sinfo --noheader --format=%P");
  return ping.status == 0 ? "" : "no Slurm controller answers: " + firstLineOf(ping.text);
}

std::string submit(const std::string& script, const std::vector<int>& tasks, const std::vector<std::string>& options) {
  std::string command = "sbatch --parsable --array=";
  for (std::size_t i = 0; i < tasks.size(); ++i) command += (i == 0 ? "" : ",") + std::to_string(tasks[i]);
  for (const std::string& option : options) command += " " + shell::quoted(option);
  const shell::Outcome told = shell::run(command + " " + shell::quoted(script));
  if (told.status != 0) throw std::runtime_error(firstLineOf(told.text));
  return told.text.substr(0, told.text.find_first_of(";\n"));  // "12" or "12;cluster"
}

std::optional<std::map<int, std::string>> tasksLeft(const std::string& array) {
  const shell::Outcome told = shell::run("squeue --noheader --array --jobs=" + array + " --format='%K %T'");
  std::map<int, std::string> left;
  if (told.text.find("Invalid job id") != std::string::npos) return left;  // forgotten: it has ended
  if (told.status != 0) return std::nullopt;
  std::istringstream lines(told.text);
  int task = 0;
  for (std::string state; lines >> task >> state;) {
    if (state != "COMPLETED" && state != "FAILED" && state != "CANCELLED" && state != "TIMEOUT") left[task] = state;
  }
  return left;
}

void cancel(const std::string& array) { shell::run("scancel " + array); }

}  // namespace presa::slurm
