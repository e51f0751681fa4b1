#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace presa {

/// A window of text for somebody at a desk: lines out, keys in. Thread: the one that opened it.
class TextWindow {
 public:
  struct Line {
    std::string text;            ///< UTF-8
    std::array<float, 3> color;  ///< red, green, blue in [0, 1]
  };

  virtual ~TextWindow() = default;
  /// What fits, in characters of equal width.
  virtual std::size_t columns() const = 0;
  virtual std::size_t rows() const = 0;
  virtual void show(const std::vector<Line>& lines) = 0;
  /// The next key pressed within that time, as a terminal would send it; 0: none. The window lives through such calls.
  virtual char key(int ms) = 0;
  /// The user closed it.
  virtual bool closed() const = 0;
};

/// Throws InputError: E590 no view in this installation, E703 no display.
std::unique_ptr<TextWindow> openTextWindow(const std::string& title);

}  // namespace presa
