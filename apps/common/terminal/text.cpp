#include "apps/common/terminal/text.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "framework/core/diagnostics/printable.h"

namespace presa::terminal {
namespace {

const char* escapeOf(Style style) {
  switch (style) {
    case Style::kPlain:
      return "";
    case Style::kStrong:
      return "\033[1m";
    case Style::kDim:
      return "\033[2m";
    case Style::kGood:
      return "\033[32m";
    case Style::kWarning:
      return "\033[33m";
    case Style::kBad:
      return "\033[31m";
  }
  return "";
}

}  // namespace

std::string format(const char* pattern, ...) {
  char text[512];
  std::va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string styled(const std::string& text, Style style, bool color) {
  if (!color || style == Style::kPlain) return text;
  return escapeOf(style) + text + "\033[0m";
}

// Continuation bytes of UTF-8 take no column.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::size_t columnsOf(std::FILE* stream) {
  winsize size{};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0) return 0;
  return size.ws_col;
}

std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent) {
  if (columns == 0) return text;
  std::string out;
  std::size_t used = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    const std::size_t width = widthOf(word);
    const bool first = at == 0;
    if (!first && used + 1 + width > columns) {
      out += "\n" + std::string(indent, ' ') + word;
      used = indent + width;
    } else {
      out += (first ? "" : " ") + word;
      used += width + (first ? 0 : 1);
    }
    if (const std::size_t line = word.rfind('\n'); line != std::string::npos) used = widthOf(word.substr(line + 1));
    at = end + 1;
  }
  return out;
}

void Line::add(const std::string& part, Style style) {
  const std::size_t gap = text_.empty() ? 0 : 2;
  const std::string shown = printable(part);  // names of fingers and phases come from a file
  const std::size_t width = widthOf(shown);
  full_ = full_ || width_ + gap + width > columns_;
  if (full_) return;
  text_.append(gap, ' ');
  text_ += styled(shown, style, color_);
  width_ += gap + width;
}

}  // namespace presa::terminal
