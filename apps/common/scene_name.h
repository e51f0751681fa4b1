#pragma once
#include <algorithm>
#include <cctype>
#include <string>

namespace presa {

/// Any text as a name that scenes and file systems allow: up to 100 letters, digits and _ - . after a letter or _.
/// Empty: "_".
inline std::string sceneName(std::string text) {
  constexpr std::size_t kLongest = 100;
  text.resize(std::min(text.size(), kLongest));
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.';
  };
  std::ranges::replace_if(
      text, [&](char c) { return !fits(c); }, '_');
  const bool begins = !text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_');
  return begins ? text : "_" + text;
}

}  // namespace presa
