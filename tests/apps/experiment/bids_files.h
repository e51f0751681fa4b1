#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/common/file_text.h"

/// A dataset's files, parsed for the rules.
namespace presa::experiment::bids {

using Json = nlohmann::json;

/// A parsed file name, such as sub-S01_ses-1_task-lift_beh.tsv.
struct Name {
  std::vector<std::pair<std::string, std::string>> entities;  ///< in the order of the file name
  std::string suffix, extension;
  std::string value(const std::string& entity) const;
};
std::optional<Name> parseName(const std::string& file);

struct File {
  std::filesystem::path path;      ///< absolute
  std::string relative;            ///< relative to the dataset
  std::vector<std::string> parts;  ///< parts of `relative`
  std::optional<Name> name;
  const std::string& base() const { return parts.back(); }
};
std::vector<File> filesOf(const std::string& dataset);

struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  /// Index of a column; -1: there is none.
  int column(const std::string& name) const;
};
/// Reads a TSV file; without a header every line is a row.
Table readTsv(const std::filesystem::path& file, bool header);
/// Returns null when the file is not JSON.
Json readJson(const std::filesystem::path& file);
bool isNumber(const std::string& cell);

}  // namespace presa::experiment::bids
