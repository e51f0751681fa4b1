#pragma once
#include <string>
#include <string_view>

namespace presa {

/// Makes text from outside (another process, a file, a device) safe for a terminal: control characters (C0 with
/// newline and tab, DEL, C1), bytes that are not UTF-8, and characters that change the writing direction, break lines
/// or have no width are written as `\xNN` or `\u{NNNN}`. All other characters stay as they are. Longer text is cut after
/// `max` characters; "..." marks the cut.
std::string printable(std::string_view text, std::size_t max = std::string_view::npos);

/// The same for text of several lines: newlines stay. HTML pages use svg::escape instead.
std::string printableLines(std::string_view text);

}  // namespace presa
