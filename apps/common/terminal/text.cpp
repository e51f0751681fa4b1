#include "apps/common/terminal/text.h"

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

/// Characters, not bytes: continuation bytes of UTF-8 take no column.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
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
