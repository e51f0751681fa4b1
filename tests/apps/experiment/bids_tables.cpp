#include "tests/apps/experiment/bids_tables.h"

#include <regex>
#include <set>

namespace presa::experiment::bids {
namespace {

namespace fs = std::filesystem;

/// rules/tabular_data: columns that must come first.
const std::map<std::string, std::vector<std::string>> kFirst{
    {"events", {"onset", "duration"}},
    {"scans", {"filename"}},
    {"sessions", {"session_id"}},
    {"participants", {"participant_id"}},
    {"channels", {"name", "component", "type", "tracked_point", "units"}}};

/// objects/columns.yaml: columns that need no entry in a dictionary.
const std::set<std::string> kDefined{"onset",       "duration",  "filename", "session_id", "participant_id",
                                     "name",        "component", "type",     "units",      "tracked_point",
                                     "description", "placement", "status",   "species",    "reference_frame"};

class TableRules {
 public:
  TableRules(const std::string& dataset, const std::vector<File>& files) : root_(dataset), files_(files) {}

  std::vector<std::string> check() {
    for (const File& file : files_) {
      if (file.parts.front() == "sourcedata" || !file.base().ends_with(".tsv")) continue;
      if (file.name && file.name->suffix == "motion") {
        for (const std::string& one : motionViolations(file)) found_.push_back(one);
        continue;
      }
      checkTable(file);
    }
    return found_;
  }

 private:
  void find(const File& file, const std::string& what) { found_.push_back(file.relative + ": " + what); }

  static std::string suffixOf(const File& file) {
    return file.name ? file.name->suffix : fs::path(file.base()).stem().string();
  }

  /// common-principles "Tabular files".
  void checkTable(const File& file) {
    const std::string text = contentsOf(file.path);
    if (text.find('\r') != std::string::npos || !text.ends_with("\n")) find(file, "Tabular files: line ends");
    const Table table = readTsv(file.path, true);
    if (table.rows.empty()) find(file, "Compulsory: an empty file should be left out");
    std::set<std::string> names;
    for (const std::string& name : table.header) {
      if (name.empty() || !names.insert(name).second) find(file, "Tabular files: column names blank or twice");
    }
    for (const auto& row : table.rows) {
      if (row.size() != table.header.size()) find(file, "Tabular files: a row has another number of cells");
      for (const std::string& cell : row) {
        if (cell.empty() || cell == "nan" || cell == "NaN" || cell == "null")
          find(file, "Tabular files: missing is n/a");
      }
    }
    const auto first = kFirst.find(suffixOf(file));
    if (first != kFirst.end()) {
      for (std::size_t i = 0; i < first->second.size(); ++i) {
        if (i >= table.header.size() || table.header[i] != first->second[i])
          return find(file, "tabular_data: " + first->second[i] + " is not where it must be");
      }
    }
    checkDictionary(file, table);
    checkContent(file, table);
  }

  /// Dictionary of a table, merged from its folder upwards [The Inheritance Principle]: same suffix, a subset of the
  /// table's entities, one per level.
  Json dictionaryOf(const File& file) {
    Json all = Json::object();
    if (!file.name) return readJson(fs::path(file.path).replace_extension(".json"));
    std::map<fs::path, int> at_level;
    for (const File& other : files_) {
      if (!other.name || other.name->suffix != file.name->suffix || other.name->extension != ".json") continue;
      const fs::path folder = other.path.parent_path();
      if (!file.path.string().starts_with(folder.string() + "/")) continue;
      bool applies = true;
      for (const auto& [key, value] : other.name->entities) applies = applies && file.name->value(key) == value;
      if (!applies) continue;
      if (++at_level[folder] > 1) find(file, "Inheritance Principle, rule 4: two dictionaries at one level");
      all.update(readJson(other.path));
    }
    return all;
  }

  /// Columns that the specification does not define must be described [tabular_data additional_columns, events.md].
  void checkDictionary(const File& file, const Table& table) {
    const Json dictionary = dictionaryOf(file);
    for (const std::string& name : table.header) {
      if (dictionary.contains(name) && !dictionary[name].is_object())
        find(file, "Tabular files: the field " + name + " must describe the column");
      if (kDefined.contains(name)) continue;
      if (!dictionary.contains(name) || dictionary[name].value("Description", "").empty())
        find(file, "additional_columns: " + name + " is not described");
    }
  }

  void checkContent(const File& file, const Table& table) {
    const std::string suffix = suffixOf(file);
    if (suffix == "events") checkEvents(file, table);
    if (suffix == "scans") checkScans(file, table);
    if (suffix == "participants") checkFolders(file, table, root_, "sub-");
    if (suffix == "sessions") checkFolders(file, table, file.path.parent_path(), "ses-");
  }

  /// events.md, objects/columns.yaml onset and duration, rules/checks/events.yaml.
  void checkEvents(const File& file, const Table& table) {
    double last = -1e9;
    for (const auto& row : table.rows) {
      if (!isNumber(row[0])) return find(file, "columns.yaml onset is a number");
      if (row[1] != "n/a" && (!isNumber(row[1]) || std::stod(row[1]) < 0))
        find(file, "columns.yaml duration >= 0 or n/a");
      if (row[0].size() - std::min(row[0].size(), row[0].find('.')) < 4) find(file, "events.md: at least 3 decimals");
      if (std::stod(row[0]) < last) find(file, "events.yaml EVENT_ONSET_ORDER");
      last = std::stod(row[0]);
    }
    const std::string base = file.base().substr(0, file.base().size() - std::string("events.tsv").size());
    const std::string suffix = file.parts[file.parts.size() - 2];  // motion: its datatype's suffix
    if (!fs::exists(file.path.parent_path() / (base + suffix + ".tsv")))
      find(file, "events.md: needs a corresponding data file");
  }

  /// data-summary-files "Scans file", rules/checks/dataset.yaml SCANS_FILENAME_NOT_MATCH_DATASET, common-principles
  /// "Units".
  void checkScans(const File& file, const Table& table) {
    static const std::regex kTime(R"((\d{4})-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z?)");
    const int time = table.column("acq_time");
    std::set<std::string> named;
    for (const auto& row : table.rows) {
      if (!fs::is_regular_file(file.path.parent_path() / row[0]))
        find(file, "SCANS_FILENAME_NOT_MATCH_DATASET " + row[0]);
      if (!named.insert(row[0]).second) find(file, "Scans file: exactly one row for each file");
      std::smatch match;
      const std::string cell = time < 0 ? "" : row[static_cast<std::size_t>(time)];
      if (!std::regex_match(cell, match, kTime) || std::stoi(match[1]) > 1925)
        find(file, "Units: date time, shifted dates to 1925 or earlier");
    }
    for (const File& other : files_) {
      const bool data = other.base().ends_with("_motion.tsv") || other.base().ends_with("_beh.tsv");
      if (data && other.path.string().starts_with(file.path.parent_path().string() + "/") &&
          !named.contains(other.path.lexically_relative(file.path.parent_path()).string()))
        find(file, "Scans file: no row for " + other.base());
    }
  }

  /// rules/checks/dataset.yaml PARTICIPANT_ID_MISMATCH; columns.yaml patterns.
  void checkFolders(const File& file, const Table& table, const fs::path& parent, const std::string& prefix) {
    std::set<std::string> listed, there;
    for (const auto& row : table.rows) {
      if (!std::regex_match(row[0], std::regex(prefix + "[0-9a-zA-Z]+"))) find(file, "columns.yaml: id " + row[0]);
      if (!listed.insert(row[0]).second) find(file, "index_columns: " + row[0] + " twice");
    }
    for (const auto& entry : fs::directory_iterator(parent)) {
      if (entry.is_directory() && entry.path().filename().string().starts_with(prefix))
        there.insert(entry.path().filename().string());
    }
    if (listed != there) find(file, "PARTICIPANT_ID_MISMATCH");
  }

  const fs::path root_;
  const std::vector<File>& files_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> tableViolations(const std::string& dataset, const std::vector<File>& files) {
  return TableRules(dataset, files).check();
}

}  // namespace presa::experiment::bids
