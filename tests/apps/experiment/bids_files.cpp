#include "tests/apps/experiment/bids_files.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace presa::experiment::bids {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

}  // namespace

std::string Name::value(const std::string& entity) const {
  for (const auto& [key, value] : entities) {
    if (key == entity) return value;
  }
  return {};
}

std::optional<Name> parseName(const std::string& file) {
  const std::size_t dot = file.find('.');
  if (dot == std::string::npos) return std::nullopt;
  Name name;
  name.extension = file.substr(dot);
  std::vector<std::string> parts = split(file.substr(0, dot), '_');
  if (parts.empty()) return std::nullopt;
  name.suffix = parts.back();
  parts.pop_back();
  for (const std::string& part : parts) {
    const std::size_t dash = part.find('-');
    if (dash == std::string::npos) return std::nullopt;
    name.entities.emplace_back(part.substr(0, dash), part.substr(dash + 1));
  }
  return name;
}

std::vector<File> filesOf(const std::string& dataset) {
  std::vector<File> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(dataset)) {
    if (!entry.is_regular_file()) continue;
    const std::string relative = entry.path().lexically_relative(dataset).string();
    const std::vector<std::string> parts = split(relative, '/');
    files.push_back({entry.path(), relative, parts, parseName(parts.back())});
  }
  return files;
}

int Table::column(const std::string& name) const {
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (header[i] == name) return static_cast<int>(i);
  }
  return -1;
}

Table readTsv(const std::filesystem::path& file, bool header) {
  Table table;
  for (const std::string& line : split(contentsOf(file), '\n')) {
    std::vector<std::string> cells = split(line + "\t", '\t');
    if (header && table.header.empty())
      table.header = std::move(cells);
    else
      table.rows.push_back(std::move(cells));
  }
  return table;
}

Json readJson(const std::filesystem::path& file) { return Json::parse(contentsOf(file), nullptr, false); }

bool isNumber(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0' && std::isfinite(value);
}

}  // namespace presa::experiment::bids
