#include "apps/common/delimited.h"

#include <utility>

namespace presa {

std::vector<DelimitedRecord> recordsOf(std::string_view text, char separator) {
  std::vector<DelimitedRecord> records;
  DelimitedRecord record;
  std::string cell;
  bool quoted = false;
  std::size_t begin = 0;
  const auto end = [&](std::size_t next) {
    record.cells.push_back(std::move(cell));
    record.raw = text.substr(begin, next - begin);
    records.push_back(std::move(record));
    record = {};
    cell.clear();
    begin = next;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool doubled = quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"';
    if (doubled)
      cell += text[i++];
    else if (c == '"')
      quoted = !quoted;
    else if (c == separator && !quoted)
      record.cells.push_back(std::exchange(cell, {}));
    else if (c == '\n' && !quoted)
      end(i + 1);
    else if (c != '\r' || quoted)
      cell += c;
  }
  if (begin < text.size()) end(text.size());
  return records;
}

std::string quotedCell(const std::string& text, char separator) {
  if (text.find_first_of(std::string("\"\n\r") + separator) == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

}  // namespace presa
