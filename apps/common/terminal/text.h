#pragma once
#include <cstddef>
#include <string>

/// Words, widths and colours for terminals.
namespace presa::terminal {

enum class Style { kPlain, kStrong, kDim, kGood, kWarning, kBad };

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

/// The text in its style; unchanged without colour.
std::string styled(const std::string& text, Style style, bool color);

/// A line of parts, two blanks apart. The first part that does not fit ends it.
class Line {
 public:
  Line(std::size_t columns, bool color) : columns_(columns), color_(color) {}
  void add(const std::string& part, Style style = Style::kPlain);
  const std::string& text() const noexcept { return text_; }

 private:
  std::size_t columns_;
  bool color_;
  bool full_ = false;
  std::size_t width_ = 0;
  std::string text_;
};

}  // namespace presa::terminal
