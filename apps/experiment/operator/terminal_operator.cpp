#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

#include "apps/common/terminal/keys.h"
#include "apps/common/terminal/status_line.h"
#include "apps/experiment/operator/keyed_operator.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::experiment {
namespace {

using terminal::Style;

/// The alternate screen of a terminal; the destructor restores the terminal.
class Screen final : public Face {
 public:
  Screen() : color_(wantsColor(stderr)) {
    if (!keys_.available() || ::isatty(STDERR_FILENO) == 0)
      refuse(953, "", "the operator's view needs a terminal", "without one: --operator none");
    std::fputs("\033[?1049h\033[?25l", stderr);
  }
  ~Screen() override { std::fputs("\033[?25h\033[?1049l", stderr); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void draw(const ConsoleView& console_view) override {
    std::string text = "\033[H";
    for (const ConsoleLine& line : console_view) text += terminal::styled(line.text, line.style, color_) + "\033[K\r\n";
    std::fputs((text + "\033[J").c_str(), stderr);
    std::fflush(stderr);
  }
  char key(int ms) override { return keys_.next(ms); }
  std::size_t columns() const override { return size().ws_col; }
  std::size_t rows() const override { return size().ws_row; }

 private:
  static winsize size() {
    winsize now{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &now) != 0 || now.ws_col == 0) now = {24, 80, 0, 0};
    return now;
  }

  terminal::Keys keys_;
  bool color_;
};

}  // namespace

std::unique_ptr<Operator> terminalOperator() { return keyedOperator(std::make_unique<Screen>()); }

}  // namespace presa::experiment
