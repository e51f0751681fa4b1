#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace presa {

/// One record of a CSV or TSV file: its bytes including the line end, and its cells without quotes. A quoted cell may
/// hold line ends and separators [RFC 4180].
struct DelimitedRecord {
  std::string_view raw;
  std::vector<std::string> cells;
};
/// `text` must outlive the records.
std::vector<DelimitedRecord> recordsOf(std::string_view text, char separator);

/// A cell as it is written to a file, quoted if necessary.
std::string quotedCell(const std::string& text, char separator);

}  // namespace presa
