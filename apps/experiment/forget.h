#pragma once
#include <string>
#include <vector>

namespace presa::experiment {

/// What a dataset holds of one subject, exports below it included. Links are not followed.
struct Traces {
  std::vector<std::string> folders;  ///< sub-ID, wherever they stand
  std::vector<std::string> files;    ///< sub-ID_*, outside of these folders
  std::vector<std::string> links;    ///< symbolic links of such a name: removed, never what they point to
  std::vector<std::string> tables;   ///< CSV and TSV files with rows of the subject
  std::vector<std::string>
      mentions;  ///< other texts that name the subject, reports for instance: left, for the user to make anew
  std::size_t files_in_folders = 0;
  /// Nothing to remove.
  bool empty() const noexcept { return folders.empty() && files.empty() && links.empty() && tables.empty(); }
};
/// Throws std::filesystem::filesystem_error when a folder cannot be read.
Traces tracesOf(const std::string& data, const std::string& subject);

/// Removes them for good. Before that it takes the locks of the subject's sessions: InputError E921 when one is being run.
/// Throws std::filesystem::filesystem_error or std::system_error at the first that stays; called again it goes on.
void forget(const Traces& traces, const std::string& subject);

}  // namespace presa::experiment
