#include "apps/experiment/forget.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>

#include "apps/common/atomic_file.h"
#include "apps/common/delimited.h"
#include "apps/common/file_text.h"
#include "apps/experiment/journal.h"

namespace presa::experiment {
namespace {

namespace fs = std::filesystem;

bool isTable(const fs::path& file) { return file.extension() == ".csv" || file.extension() == ".tsv"; }
char separatorOf(const fs::path& file) { return file.extension() == ".csv" ? ',' : '\t'; }

/// Text files made from a dataset, such as reports.
bool isText(const fs::path& file) {
  static const std::set<std::string> kKinds{"", ".html", ".json", ".md", ".rst", ".svg", ".tex", ".txt"};
  return kKinds.contains(file.extension().string());
}

/// True when the first cell names the subject, in the form of BIDS or of trials.csv.
bool isRowOf(const DelimitedRecord& record, const std::string& subject) {
  const std::string& cell = record.cells.front();
  return cell == subject || cell == "sub-" + subject;
}

bool hasRows(const fs::path& file, const std::string& subject) {
  const std::string text = contentsOf(file);
  const auto records = recordsOf(text, separatorOf(file));
  return std::any_of(records.begin(), records.end(), [&](const DelimitedRecord& one) { return isRowOf(one, subject); });
}

/// The file without the subject's rows; all other bytes are unchanged.
std::string withoutRows(const fs::path& file, const std::string& subject) {
  const std::string text = contentsOf(file);
  std::string kept;
  for (const DelimitedRecord& record : recordsOf(text, separatorOf(file))) {
    if (!isRowOf(record, subject)) kept += record.raw;
  }
  return kept;
}

/// True when the text contains the pseudonym as a whole word. A pseudonym of digits only must have its prefix "sub-":
/// otherwise every number would match.
bool names(const std::string& text, const std::string& subject) {
  const bool digits = std::all_of(subject.begin(), subject.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const std::string word = digits ? "sub-" + subject : subject;
  const auto inside = [&](std::size_t at) {
    return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])) != 0;
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (!(at > 0 && inside(at - 1)) && !inside(at + word.size())) return true;
  }
  return false;
}

/// Name of a folder, with or without a trailing slash.
std::string nameOf(const fs::path& folder) {
  return folder.has_filename() ? folder.filename().string() : folder.parent_path().filename().string();
}

/// Walks over a dataset and collects a subject's traces.
class Search {
 public:
  explicit Search(const std::string& subject) : subject_(subject), prefix_("sub-" + subject) {}

  Traces in(const std::string& data) {
    if (nameOf(data) == prefix_ && !fs::is_symlink(data)) {
      takeFolder(data);
      return traces_;
    }
    const fs::recursive_directory_iterator end;
    for (auto at = fs::recursive_directory_iterator(data); at != end; ++at) {
      const std::string name = at->path().filename().string();
      if (name == prefix_ || name.starts_with(prefix_ + "_") || name.starts_with(prefix_ + ".")) {
        if (at->is_directory() && !at->is_symlink()) at.disable_recursion_pending();
        take(*at, name);
      } else if (at->is_regular_file() && !at->is_symlink()) {
        look(at->path());
      }
    }
    return traces_;
  }

 private:
  void takeFolder(const fs::path& folder) {
    traces_.folders.push_back(folder.string());
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      traces_.files_in_folders += entry.is_symlink() || entry.is_regular_file() ? 1 : 0;
  }

  void take(const fs::directory_entry& entry, const std::string& name) {
    if (entry.is_symlink())
      traces_.links.push_back(entry.path().string());
    else if (entry.is_directory())
      takeFolder(entry.path());
    else if (name != prefix_)
      traces_.files.push_back(entry.path().string());
  }

  /// Skips tables inside sessions: they hold one subject only and are covered by the checksums.
  void look(const fs::path& file) {
    if (fs::exists(file.parent_path() / kJournal)) return;
    if (isTable(file)) {
      if (hasRows(file, subject_)) traces_.tables.push_back(file.string());
    } else if (isText(file) && names(contentsOf(file), subject_)) {
      traces_.mentions.push_back(file.string());
    }
  }

  const std::string& subject_;
  const std::string prefix_;
  Traces traces_;
};

/// Locks the sessions, so that none is resumed while it is being removed.
std::vector<Journal> lockSessions(const std::vector<std::string>& folders) {
  std::vector<Journal> locks;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().filename() == kJournal && !entry.is_symlink())
        locks.push_back(Journal::hold(entry.path().string()));
    }
  }
  return locks;
}

}  // namespace

Traces tracesOf(const std::string& data, const std::string& subject) { return Search(subject).in(data); }

void forget(const Traces& traces, const std::string& subject) {
  const std::vector<Journal> locks = lockSessions(traces.folders);
  for (const std::string& table : traces.tables) writeFileAtomically(table, withoutRows(table, subject));
  for (const std::string& link : traces.links) fs::remove(link);
  for (const std::string& file : traces.files) fs::remove(file);
  for (const std::string& folder : traces.folders) fs::remove_all(folder);
}

}  // namespace presa::experiment
