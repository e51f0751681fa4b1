#include "framework/core/diagnostics/printable.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace presa {
namespace {

struct Character {
  std::uint32_t point = 0;
  std::size_t bytes = 0;  // 0: not UTF-8
};

// Decodes UTF-8 by RFC 3629: no overlong forms, no surrogates, nothing above 10FFFF.
Character characterAt(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[at + i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + bytes > text.size()) return {};
  std::uint32_t point = first & (0x7FU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    point = point << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kSmallest{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = point >= 0xD800 && point <= 0xDFFF;
  if (point < kSmallest[bytes] || surrogate || point > 0x10FFFF) return {};
  return {point, bytes};
}

bool obeyed(std::uint32_t point) {
  const auto in = [point](std::uint32_t from, std::uint32_t to) { return point >= from && point <= to; };
  return point < 0x20 || in(0x7F, 0x9F) || point == 0xAD || point == 0x61C ||  // controls, soft hyphen, arabic mark
         in(0x200B, 0x200F) || in(0x2028, 0x202E) || in(0x2060, 0x206F) ||     // no width, lines, directions
         point == 0xFEFF || in(0xFFF9, 0xFFFB) || in(0xE0000, 0xE007F);        // mark of order, notes, tags
}

std::string print(const char* format, unsigned value) {
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

std::string printable(std::string_view text, std::size_t max) {
  std::string shown;
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); ++count) {
    if (count == max) return shown + "...";
    const Character character = characterAt(text, at);
    if (character.bytes == 0 || (character.bytes == 1 && obeyed(character.point)))
      shown += print("\\x%02X", static_cast<unsigned char>(text[at]));
    else if (obeyed(character.point))
      shown += print("\\u{%X}", character.point);
    else
      shown += text.substr(at, character.bytes);
    at += character.bytes == 0 ? 1 : character.bytes;
  }
  return shown;
}

std::string printableLines(std::string_view text) {
  std::string shown;
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find('\n', begin);
    shown += printable(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return shown;
    shown += '\n';
    begin = end + 1;
  }
}

}  // namespace presa
