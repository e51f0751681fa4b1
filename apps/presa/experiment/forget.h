#pragma once
#include <string>
#include <vector>

namespace presa::experiment {

/// What a dataset holds of one subject: folders sub-ID wherever they stand, and lines of participants.tsv.
struct Traces {
  std::vector<std::string> folders;
  std::vector<std::string> tables;  ///< files with rows of the subject
  std::size_t files = 0;            ///< in the folders
  bool empty() const noexcept { return folders.empty() && tables.empty(); }
};
Traces tracesOf(const std::string& data, const std::string& subject);

/// Removes them for good. Throws std::filesystem::filesystem_error or std::system_error at the first that stays.
void forget(const Traces& traces, const std::string& subject);

}  // namespace presa::experiment
