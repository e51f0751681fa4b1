#include "tests/apps/experiment/bids_rules.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

#include "tests/apps/experiment/bids_files.h"
#include "tests/apps/experiment/bids_tables.h"

namespace presa::experiment::bids {
namespace {

namespace fs = std::filesystem;

/// rules/entities.yaml: the order of entities in a name (only those that occur here).
const std::vector<std::string> kOrder{"sub", "ses", "sample", "task", "tracksys", "acq", "run", "recording"};

/// rules/files/raw and rules/files/common/tables.yaml: required and optional entities of a file.
struct FileRule {
  std::string datatype, suffix;
  std::set<std::string> extensions, required, optional;
};
const std::vector<FileRule> kFiles{
    {"beh", "beh", {".tsv", ".json"}, {"sub", "task"}, {"ses", "acq", "run"}},
    {"beh", "events", {".tsv", ".json"}, {"sub", "task"}, {"ses", "acq", "run"}},
    {"motion", "motion", {".tsv", ".json"}, {"sub", "task", "tracksys"}, {"ses", "acq", "run"}},
    {"motion", "channels", {".tsv", ".json"}, {"sub", "task", "tracksys"}, {"ses", "acq", "run"}},
    {"motion", "events", {".tsv", ".json"}, {"sub", "task", "tracksys"}, {"ses", "acq", "run"}},
    {"", "scans", {".tsv", ".json"}, {"sub"}, {"ses"}},
    {"", "sessions", {".tsv", ".json"}, {"sub"}, {}},
};

class Rules {
 public:
  explicit Rules(const std::string& dataset) : files_(filesOf(dataset)), root_(dataset) {}

  std::vector<std::string> check() {
    checkRoot();
    for (const File& file : files_) {
      if (file.parts.front() == "sourcedata") continue;  // common-principles "Source data": no naming scheme
      checkPlain(file);
      if (file.parts.size() > 1) checkPlace(file);
    }
    for (const std::string& one : tableViolations(root_.string(), files_)) found_.push_back(one);
    return found_;
  }

 private:
  void find(const std::string& where, const std::string& what) { found_.push_back(where + ": " + what); }

  /// rules/files/common/core.yaml, rules/dataset_metadata.yaml, rules/checks/{general,dataset}.yaml.
  void checkRoot() {
    static const std::set<std::string> kAllowed{"dataset_description.json", "README", "participants.tsv",
                                                "participants.json", "sourcedata"};
    for (const auto& entry : fs::directory_iterator(root_)) {
      const std::string name = entry.path().filename().string();
      if (!kAllowed.contains(name) && !(entry.is_directory() && name.starts_with("sub-")))
        find(name, "core.yaml: no such file or folder in the root");
    }
    const Json json = readJson(root_ / "dataset_description.json");
    if (!json.is_object()) return find("dataset_description.json", "dataset_metadata.yaml: is required");
    for (const char* field : {"Name", "BIDSVersion", "License", "DatasetType"}) {
      if (!json.contains(field) || !json[field].is_string() || json[field].get<std::string>().empty())
        find("dataset_description.json", std::string("dataset_metadata.yaml: needs a string ") + field);
    }
    // objects/metadata.yaml: format of releases; DatasetType is an enumeration; GeneratedBy holds objects with a Name
    if (!std::regex_match(json.value("BIDSVersion", ""), std::regex(R"(1\.\d+\.\d+)")))
      find("dataset_description.json", "dataset.yaml UNKNOWN_BIDS_VERSION");
    if (json.value("DatasetType", "") != "raw") find("dataset_description.json", "DatasetType is not raw");
    if (!json.contains("GeneratedBy") || !json["GeneratedBy"].is_array() || json["GeneratedBy"].empty() ||
        !json["GeneratedBy"][0].contains("Name"))
      find("dataset_description.json", "GeneratedBy is not a list of objects with a Name");
    if (json.contains("Authors") && !json["Authors"].is_array()) find("dataset_description.json", "Authors is no list");
    if (contentsOf(root_ / "README").size() <= 150) find("README", "general.yaml README_FILE_SMALL");
  }

  /// common-principles "Dotfiles", "Case collision intolerance", "File format specification".
  void checkPlain(const File& file) {
    if (file.base().starts_with(".")) find(file.relative, "Dotfiles: reserved");
    if (file.base().size() > 255) find(file.relative, "Filenames: longer than 255 characters");
    std::string lower = file.relative;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    if (!lowered_.insert(lower).second) find(file.relative, "Case collision intolerance");
    if (file.base().ends_with(".json") && !readJson(file.path).is_object()) find(file.relative, "is not a JSON object");
  }

  /// common-principles "Filesystem structure": sub-<label>/[ses-<label>/]<datatype>/, repeated in the file names.
  void checkPlace(const File& file) {
    if (!file.name) return find(file.relative, "Filenames: not a chain of entities and a suffix");
    const std::string subject = "sub-" + file.name->value("sub"), session = file.name->value("ses");
    std::vector<std::string> place{subject};
    if (!session.empty()) place.push_back("ses-" + session);
    const FileRule* rule = nullptr;
    for (const FileRule& one : kFiles) {
      std::vector<std::string> folders = place;
      if (!one.datatype.empty()) folders.push_back(one.datatype);
      folders.push_back(file.base());
      if (one.suffix == file.name->suffix && folders == file.parts) rule = &one;
    }
    if (rule == nullptr) return find(file.relative, "files/raw: no file of this suffix stands here");
    if (!rule->extensions.contains(file.name->extension)) find(file.relative, "files/raw: extension");
    checkEntities(file, *rule);
  }

  void checkEntities(const File& file, const FileRule& rule) {
    static const std::regex kLabel("[0-9a-zA-Z]+"), kIndex("[0-9]+");  // objects/formats.yaml
    std::size_t last = 0;
    std::set<std::string> present;
    for (const auto& [key, value] : file.name->entities) {
      const auto place = std::find(kOrder.begin(), kOrder.end(), key);
      if (place == kOrder.end()) return find(file.relative, "objects/entities.yaml: no entity " + key);
      const auto at = static_cast<std::size_t>(place - kOrder.begin()) + 1;
      if (at <= last) find(file.relative, "rules/entities.yaml: " + key + " is out of order, or twice");
      last = at;
      present.insert(key);
      if (!rule.required.contains(key) && !rule.optional.contains(key))
        find(file.relative, "files/raw: may not have " + key);
      if (!std::regex_match(value, key == "run" ? kIndex : kLabel)) find(file.relative, "formats: " + key);
    }
    // a dictionary in a folder above its tables has fewer entities [The Inheritance Principle, rule 2.c]
    for (const std::string& key : rule.required) {
      if (!present.contains(key)) find(file.relative, "files/raw: needs " + key);
    }
  }

  const std::vector<File> files_;
  const fs::path root_;
  std::set<std::string> lowered_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> violations(const std::string& dataset) { return Rules(dataset).check(); }

}  // namespace presa::experiment::bids
