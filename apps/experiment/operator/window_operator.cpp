#include <array>

#include "apps/experiment/operator/keyed_operator.h"
#include "framework/session/text_window.h"

namespace presa::experiment {
namespace {

using terminal::Style;

std::array<float, 3> colorOf(Style style) {
  switch (style) {
    case Style::kStrong:
      return {1, 1, 1};
    case Style::kDim:
      return {0.58F, 0.62F, 0.68F};
    case Style::kGood:
      return {0.45F, 0.83F, 0.50F};
    case Style::kWarning:
      return {0.98F, 0.76F, 0.30F};
    case Style::kBad:
      return {1, 0.42F, 0.38F};
    case Style::kPlain:
      break;
  }
  return {0.84F, 0.86F, 0.89F};
}

class WindowFace final : public Face {
 public:
  void draw(const ConsoleView& console_view) override {
    std::vector<TextWindow::Line> lines;
    lines.reserve(console_view.size());
    for (const ConsoleLine& line : console_view) lines.push_back({line.text, colorOf(line.style)});
    window_->show(lines);
  }
  char key(int ms) override { return window_->key(ms); }
  std::size_t columns() const override { return window_->columns(); }
  std::size_t rows() const override { return window_->rows(); }
  bool closed() const override { return window_->closed(); }

 private:
  std::unique_ptr<TextWindow> window_ = openTextWindow("Presa: operator");
};

}  // namespace

std::unique_ptr<Operator> windowOperator() { return keyedOperator(std::make_unique<WindowFace>()); }

}  // namespace presa::experiment
