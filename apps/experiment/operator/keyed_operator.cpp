#include "apps/experiment/operator/keyed_operator.h"

#include <utility>

#include "framework/core/schedule/clock.h"

namespace presa::experiment {
namespace {

class KeyedOperator final : public Operator {
 public:
  explicit KeyedOperator(std::unique_ptr<Face> face) : face_(std::move(face)) {}

  void show(const SessionView& view) override {
    view_ = view;
    readKeys();
    const std::int64_t now = monotonicNs();
    if (now < next_ns_) return;
    next_ns_ = now + 100'000'000;
    draw();
  }

  Request request() override {
    if (gone()) return Request::kStop;
    return std::exchange(request_, Request::kNone);
  }

  std::optional<std::string> takeNote() override { return std::exchange(note_, std::nullopt); }

  Request await(const std::string& why, double seconds) override {
    const std::int64_t until = monotonicNs() + static_cast<std::int64_t>(seconds * 1e9);
    for (;;) {
      const double left = static_cast<double>(until - monotonicNs()) * 1e-9;
      prompt_ = left > 0 ? why + terminal::format("   %.0f s more   q stop", left)
                         : why + "   space goes on   n note   q stop";
      draw();
      const char key = face_->key(100);
      if (participant_) participant_();
      if (gone()) return Request::kStop;
      if (key == 'n' || writing_)
        take(key);
      else if (key == 'q')
        return Request::kStop;
      else if (left <= 0 && (key == ' ' || key == '\n'))
        break;
    }
    prompt_.clear();
    return Request::kNone;
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

  void listenTo(std::function<char()> participant) override { participant_ = std::move(participant); }
  void ended(const std::string& what) override { view_.last = what; }

 private:
  /// True after Ctrl-C or when the display is closed.
  bool gone() const { return terminal::Interruption::came() || face_->closed(); }

  /// Waits for one of the keys `allowed`; 0: the operator stops.
  char answer(const std::string& question, const std::string& allowed) {
    prompt_ = question;
    for (;;) {
      draw();
      const char key = face_->key(100);
      const char other = participant_ ? participant_() : 0;
      if (gone() || key == 'q') return 0;
      for (const char pressed : {key, other}) {
        if (pressed == 0 || allowed.find(pressed) == std::string::npos) continue;
        prompt_.clear();
        return pressed;
      }
    }
  }

  void readKeys() {
    for (char key = face_->key(0); key != 0; key = face_->key(0)) take(key);
  }

  void take(char key) {
    if (writing_) return write(key);
    switch (key) {
      case 'p':
        request_ = Request::kPause;
        break;
      case 'r':
        request_ = Request::kRepeat;
        break;
      case 's':
        request_ = Request::kSkip;
        break;
      case 'q':
        request_ = Request::kStop;
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
    SessionView view = view_;
    if (!prompt_.empty()) view.asked = prompt_;
    if (writing_) view.asked = "note: " + text_ + "_   (Enter keeps it, Esc drops it)";
    face_->draw(consoleViewOf(view, face_->columns(), face_->rows()));
  }

  std::unique_ptr<Face> face_;
  std::function<char()> participant_;
  SessionView view_;
  Request request_ = Request::kNone;
  std::optional<std::string> note_;
  std::string prompt_, text_;
  bool writing_ = false;
  std::int64_t next_ns_ = 0;
};

}  // namespace

std::unique_ptr<Operator> keyedOperator(std::unique_ptr<Face> face) {
  return std::make_unique<KeyedOperator>(std::move(face));
}

}  // namespace presa::experiment
