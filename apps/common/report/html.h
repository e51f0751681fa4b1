#pragma once
#include <string>
#include <vector>

/// Tables of a page. Cells must be HTML, already escaped.
namespace presa::html {

inline std::string row(const std::vector<std::string>& cells, const std::string& tag = "td") {
  const std::string open = "<" + tag + ">", close = "</" + tag + ">";
  std::string out = "<tr>";
  for (const std::string& cell : cells) {
    out += open;
    out += cell;
    out += close;
  }
  return out + "</tr>\n";
}

inline std::string table(const std::vector<std::string>& head, const std::string& rows) {
  return "<div class=\"scroll\"><table><thead>" + row(head, "th") + "</thead><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

/// A section that the reader opens; `title` is already escaped. Empty without content.
inline std::string folded(const std::string& title, const std::string& content) {
  if (content.empty()) return {};
  return "<details class=\"part\"><summary>" + title + "</summary>\n" + content + "</details>\n";
}

}  // namespace presa::html
