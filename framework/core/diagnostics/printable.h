#pragma once
#include <string>
#include <string_view>

namespace presa {

/// Text from outside (another process, a file, a device), for the terminal: what a terminal would obey, or would show as something
/// else, stands there as \xNN or \u{NNNN}. That are control characters (C0 with newline and tab, DEL, C1), bytes that are not UTF-8, and the
/// characters that turn the direction of writing, break lines or have no width. Everything else stays as it is.
std::string printable(std::string_view text);

/// The same, of at most `most` characters; what is longer ends in "...".
std::string printable(std::string_view text, std::size_t most);

/// The same of text that has lines: they stay. For pages there is svg::escape.
std::string printableLines(std::string_view text);

}  // namespace presa
