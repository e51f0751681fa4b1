#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace presa {

/// A window for an operator that shows lines of text and reads keys. Thread: the one that opened it.
class TextWindow {
 public:
  struct Line {
    std::string text;            ///< UTF-8
    std::array<float, 3> color;  ///< red, green, blue in [0, 1]
  };

  virtual ~TextWindow() = default;
  /// Size of the window in characters of equal width.
  virtual std::size_t columns() const = 0;
  virtual std::size_t rows() const = 0;
  virtual void show(const std::vector<Line>& lines) = 0;
  /// Waits up to `ms` for a key and returns it as a terminal would send it; 0: none. Call it often: it also updates the
  /// window.
  virtual char key(int ms) = 0;
  /// Whether the user has closed the window.
  virtual bool closed() const = 0;
};

/// Throws InputError: E590 no view in this installation, E703 no display.
std::unique_ptr<TextWindow> openTextWindow(const std::string& title);

}  // namespace presa
