#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>

#include "apps/presa/experiment/operator/keyed_operator.h"
#include "apps/presa/terminal/status_line.h"
#include "framework/diagnostics/refuse.h"

namespace presa::experiment {
namespace {

using terminal::Style;

/// The other screen of a terminal, keys one by one and unseen; all as it was afterwards.
class Screen final : public Face {
 public:
  Screen() : color_(wantsColor(stderr)) {
    if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDERR_FILENO) == 0)
      refuse(953, "", "the operator's view needs a terminal", "without one: --operator none");
    ::tcgetattr(STDIN_FILENO, &old_);
    termios raw = old_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // signals stay: Ctrl-C stops cleanly
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    ::tcsetattr(STDIN_FILENO, TCSANOW, &raw);
    std::fputs("\033[?1049h\033[?25l", stderr);
  }
  ~Screen() override {
    std::fputs("\033[?25h\033[?1049l", stderr);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &old_);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void draw(const Board& board) override {
    std::string text = "\033[H";
    for (const BoardLine& line : board) text += terminal::styled(line.text, line.style, color_) + "\033[K\r\n";
    std::fputs((text + "\033[J").c_str(), stderr);
    std::fflush(stderr);
  }
  char key(int ms) override {
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    char pressed = 0;
    if (::poll(&waiting, 1, ms) <= 0 || ::read(STDIN_FILENO, &pressed, 1) != 1) return 0;
    return pressed;
  }
  std::size_t columns() const override { return size().ws_col; }
  std::size_t rows() const override { return size().ws_row; }

 private:
  static winsize size() {
    winsize now{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &now) != 0 || now.ws_col == 0) now = {24, 80, 0, 0};
    return now;
  }

  termios old_{};
  bool color_;
};

}  // namespace

std::unique_ptr<Operator> terminalOperator() { return keyedOperator(std::make_unique<Screen>()); }

}  // namespace presa::experiment
