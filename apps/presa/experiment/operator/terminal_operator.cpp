#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "apps/presa/experiment/operator/board.h"
#include "apps/presa/experiment/operator/operator.h"
#include "apps/presa/terminal/interruption.h"
#include "apps/presa/terminal/status_line.h"
#include "framework/diagnostics/refuse.h"
#include "framework/schedule/clock.h"

namespace presa::experiment {
namespace {

using terminal::Interruption;
using terminal::Style;

/// The other screen of a terminal, keys one by one and unseen; all as it was afterwards.
class Screen {
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
  ~Screen() {
    std::fputs("\033[?25h\033[?1049l", stderr);
    ::tcsetattr(STDIN_FILENO, TCSANOW, &old_);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void draw(const Board& board) const {
    std::string text = "\033[H";
    for (const BoardLine& line : board) text += terminal::styled(line.text, line.style, color_) + "\033[K\r\n";
    std::fputs((text + "\033[J").c_str(), stderr);
    std::fflush(stderr);
  }
  /// The next key within `ms`; 0: none.
  static char key(int ms) {
    pollfd waiting{STDIN_FILENO, POLLIN, 0};
    char pressed = 0;
    if (::poll(&waiting, 1, ms) <= 0 || ::read(STDIN_FILENO, &pressed, 1) != 1) return 0;
    return pressed;
  }
  static winsize size() {
    winsize now{};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &now) != 0 || now.ws_col == 0) now = {24, 80, 0, 0};
    return now;
  }

 private:
  termios old_{};
  bool color_;
};

class TerminalOperator final : public Operator {
 public:
  void show(const SessionView& view) override {
    view_ = view;
    readKeys();
    const std::int64_t now = monotonicNs();
    if (now < next_ns_) return;
    next_ns_ = now + 100'000'000;
    draw();
  }

  Wish wish() override {
    if (Interruption::came()) return Wish::kStop;
    return std::exchange(wish_, Wish::kNone);
  }

  std::optional<std::string> takeNote() override { return std::exchange(note_, std::nullopt); }

  Wish await(const std::string& why, double seconds) override {
    const std::int64_t until = monotonicNs() + static_cast<std::int64_t>(seconds * 1e9);
    for (;;) {
      const double left = static_cast<double>(until - monotonicNs()) * 1e-9;
      prompt_ = left > 0 ? why + terminal::format("   %.0f s more   q stop", left)
                         : why + "   space goes on   n note   q stop";
      draw();
      const char key = Screen::key(100);
      if (Interruption::came()) return Wish::kStop;
      if (key == 'n' || writing_)
        take(key);
      else if (key == 'q')
        return Wish::kStop;
      else if (left <= 0 && (key == ' ' || key == '\n'))
        break;
    }
    prompt_.clear();
    return Wish::kNone;
  }

  std::optional<int> ask(const std::string& question) override {
    const char key = answer(question + "   1 or 2", "12");
    return key == 0 ? std::nullopt : std::optional<int>(key - '0');
  }

  std::optional<psychophysics::AdjustmentKey> askAdjust(const std::string& question) override {
    using Key = psychophysics::AdjustmentKey;
    switch (answer(question + "   + - coarse   . , fine   space confirms", "+-., ")) {
      case '+':
        return Key::kUp;
      case '-':
        return Key::kDown;
      case '.':
        return Key::kUpFine;
      case ',':
        return Key::kDownFine;
      case ' ':
        return Key::kConfirm;
      default:
        return std::nullopt;
    }
  }

  void ended(const std::string& what) override { view_.last = what; }

 private:
  /// One of `allowed`; 0: the operator stops.
  char answer(const std::string& question, const std::string& allowed) {
    prompt_ = question;
    for (;;) {
      draw();
      const char key = Screen::key(100);
      if (Interruption::came() || key == 'q') return 0;
      if (key == 0 || allowed.find(key) == std::string::npos) continue;
      prompt_.clear();
      return key;
    }
  }

  void readKeys() {
    for (char key = Screen::key(0); key != 0; key = Screen::key(0)) take(key);
  }

  void take(char key) {
    if (writing_) return write(key);
    switch (key) {
      case 'p':
        wish_ = Wish::kPause;
        break;
      case 'r':
        wish_ = Wish::kRepeat;
        break;
      case 's':
        wish_ = Wish::kSkip;
        break;
      case 'q':
        wish_ = Wish::kStop;
        break;
      case 'n':
        writing_ = true;
        text_.clear();
        break;
      default:
        break;
    }
  }

  void write(char key) {
    if (key == '\n' || key == '\r') {
      if (!text_.empty()) note_ = text_;
      writing_ = false;
    } else if (key == 27) {
      writing_ = false;
    } else if (key == 127 || key == 8) {
      if (!text_.empty()) text_.pop_back();
    } else if (static_cast<unsigned char>(key) >= 32) {
      text_ += key;
    }
  }

  void draw() {
    const winsize size = Screen::size();
    SessionView view = view_;
    if (!prompt_.empty()) view.asked = prompt_;
    if (writing_) view.asked = "note: " + text_ + "_   (Enter keeps it, Esc drops it)";
    screen_.draw(boardOf(view, size.ws_col, size.ws_row));
  }

  Interruption interruption_;
  Screen screen_;
  SessionView view_;
  Wish wish_ = Wish::kNone;
  std::optional<std::string> note_;
  std::string prompt_, text_;
  bool writing_ = false;
  std::int64_t next_ns_ = 0;
};

}  // namespace

std::unique_ptr<Operator> terminalOperator() { return std::make_unique<TerminalOperator>(); }

}  // namespace presa::experiment
