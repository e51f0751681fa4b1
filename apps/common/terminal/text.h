#pragma once
#include <cstddef>
#include <cstdio>
#include <string>

/// Words, widths and colours for terminals.
namespace presa::terminal {

enum class Style { kPlain, kStrong, kDim, kGood, kWarning, kBad };

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

/// The text in its style; unchanged without colour.
std::string styled(const std::string& text, Style style, bool color);

/// Characters, not bytes.
std::size_t widthOf(const std::string& text);

/// Width of the terminal behind the stream; 0: it is none.
std::size_t columnsOf(std::FILE* stream);

/// The text in lines of at most so many columns, broken between words; `indent` blanks before all but the first. 0
/// columns: as it is. A word that is too long stays whole.
std::string wrapped(const std::string& text, std::size_t columns, std::size_t indent);

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
