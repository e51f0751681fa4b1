#include "apps/presa/experiment/forget.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/presa/atomic_file.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

/// Its first cell is the subject, as BIDS and as trials.csv write it.
bool isRowOf(const std::string& line, const std::string& subject) {
  const std::string cell = line.substr(0, line.find_first_of(",\t\r"));
  return cell == subject || cell == "sub-" + subject;
}

bool isTable(const fs::path& file) { return file.extension() == ".csv" || file.extension() == ".tsv"; }

bool hasRows(const fs::path& file, const std::string& subject) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (isRowOf(line, subject)) return true;
  }
  return false;
}

std::string withoutRows(const std::string& file, const std::string& subject) {
  std::ifstream in(file);
  std::string kept;
  for (std::string line; std::getline(in, line);) {
    if (!isRowOf(line, subject)) kept += line + "\n";
  }
  return kept;
}

}  // namespace

Traces tracesOf(const std::string& data, const std::string& subject) {
  Traces traces;
  for (auto at = fs::recursive_directory_iterator(data); at != fs::recursive_directory_iterator(); ++at) {
    if (at->is_directory() && at->path().filename() == "sub-" + subject) {
      traces.folders.push_back(at->path().string());
      at.disable_recursion_pending();
      for (const auto& entry : fs::recursive_directory_iterator(at->path()))
        traces.files += entry.is_regular_file() ? 1 : 0;
    } else if (at->is_regular_file() && isTable(at->path()) && hasRows(at->path(), subject)) {
      traces.tables.push_back(at->path().string());
    }
  }
  return traces;
}

void forget(const Traces& traces, const std::string& subject) {
  for (const std::string& table : traces.tables) writeFileAtomically(table, withoutRows(table, subject));
  for (const std::string& folder : traces.folders) fs::remove_all(folder);
}

}  // namespace presa::experiment
