#pragma once
#include <string>
#include <vector>

namespace presa::experiment {

/// The data of one subject in a dataset, exports below it included. Links are not followed.
struct Traces {
  std::vector<std::string> folders;  ///< folders named sub-ID, at any depth
  std::vector<std::string> files;    ///< files named sub-ID_*, outside of these folders
  std::vector<std::string> links;    ///< symbolic links with such a name: the links are removed, never their targets
  std::vector<std::string> tables;   ///< CSV and TSV files with rows of the subject
  std::vector<std::string>
      mentions;  ///< other texts that name the subject, such as reports: kept, for the user to regenerate
  std::size_t files_in_folders = 0;
  /// True when there is nothing to remove.
  bool empty() const noexcept { return folders.empty() && files.empty() && links.empty() && tables.empty(); }
};
/// Throws std::filesystem::filesystem_error when a folder cannot be read.
Traces tracesOf(const std::string& data, const std::string& subject);

/// Deletes the traces. Locks the subject's sessions first: InputError E921 when one of them is running. Throws
/// std::filesystem::filesystem_error or std::system_error at the first trace that cannot be removed; a second call
/// removes the rest.
void forget(const Traces& traces, const std::string& subject);

}  // namespace presa::experiment
