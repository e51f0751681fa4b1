#include "apps/common/report/svg_symbols.h"

#include <algorithm>

#include "apps/common/report/svg_scale.h"
#include "apps/common/terminal/text.h"

namespace presa::svg {

std::string colorClass(int color) {
  if (color >= kRamp) return "r" + std::to_string(std::min(color - kRamp, kRampSteps - 1));
  return color < 0 ? "ink" : "s" + std::to_string(color % kColors);
}

std::string symbolPath(double x, double y, double r, int shape) {
  const auto at = [&](double dx, double dy) { return px(x + dx) + " " + px(y + dy); };
  switch (shape % 6) {
    case 0:
      return "M" + at(-r, 0) + "a" + px(r) + " " + px(r) + " 0 1 0 " + px(2 * r) + " 0a" + px(r) + " " + px(r) +
             " 0 1 0 " + px(-2 * r) + " 0z";
    case 1:
      return "M" + at(-r, -r) + "L" + at(r, -r) + "L" + at(r, r) + "L" + at(-r, r) + "z";
    case 2:
      return "M" + at(0, -1.2 * r) + "L" + at(1.1 * r, 0.9 * r) + "L" + at(-1.1 * r, 0.9 * r) + "z";
    case 3:
      return "M" + at(0, -1.3 * r) + "L" + at(1.3 * r, 0) + "L" + at(0, 1.3 * r) + "L" + at(-1.3 * r, 0) + "z";
    case 4:
      return "M" + at(0, 1.2 * r) + "L" + at(1.1 * r, -0.9 * r) + "L" + at(-1.1 * r, -0.9 * r) + "z";
    default:
      return "M" + at(-r, -r) + "L" + at(r, r) + "M" + at(-r, r) + "L" + at(r, -r);
  }
}

double textWidth(const std::string& text) { return 7 * static_cast<double>(terminal::widthOf(text)); }

std::string pointLabels(const std::vector<PointLabel>& labels, const Box& area, std::vector<Box> taken) {
  struct Side {
    double x, y;
  };
  constexpr Side kSides[] = {{1, 0}, {-1, 0}, {0.8, -0.8}, {-0.8, -0.8}, {0.8, 0.8}, {-0.8, 0.8}, {0, -1}, {0, 1}};
  constexpr double kHalf = 7;  // of a line of text
  std::string out;
  for (const PointLabel& label : labels) {
    const double width = textWidth(label.text);
    const auto boxAt = [&](const Side& side, double r) {
      const double x = label.at.x + side.x * r, y = label.at.y + side.y * r;
      const double left = side.x > 0 ? x : side.x < 0 ? x - width : x - width / 2;
      return Box{left, y - kHalf, left + width, y + kHalf};
    };
    const auto free = [&](const Box& box) {
      return area.holds(box) &&
             std::none_of(taken.begin(), taken.end(), [&](const Box& other) { return box.meets(other); });
    };
    double reach = 0;
    Box chosen = boxAt(kSides[0], 10);
    bool found = false;
    for (const double r : {10.0, 18.0, 28.0, 40.0, 54.0, 70.0, 90.0, 115.0}) {
      for (const Side& side : kSides) {
        const Box box = boxAt(side, r);
        if (found || !free(box)) continue;
        found = true;
        reach = r;
        chosen = box;
      }
    }
    if (!found && !label.needed) continue;
    if (!found && !area.holds(chosen)) chosen = boxAt(kSides[1], 10);
    taken.push_back(chosen);
    if (reach > 18) {
      const double x = std::clamp(label.at.x, chosen.left, chosen.right);
      const double y = std::clamp(label.at.y, chosen.top + 2, chosen.bottom - 2);
      out += lineFromTo(label.at.x, label.at.y, x, y, "leader");
    }
    out += textAt(chosen.left, chosen.bottom - 3, "legend", escape(label.text));
  }
  return out;
}

}  // namespace presa::svg
