#include <algorithm>
#include <cmath>

#include "apps/common/number_text.h"
#include "apps/common/report/svg_plot.h"

namespace presa::svg {
namespace {

constexpr int kMaxDecimals = 5;  // more digits than that do not fit beside an axis

}  // namespace

std::vector<double> niceTicks(double low, double high, int target) {
  if (!(high > low) || !std::isfinite(high - low)) return {low};
  const double raw = (high - low) / std::max(target, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  const double step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  // counts whole steps, so that rounding errors do not accumulate along the axis
  const double slack = 1e-9;
  for (double k = std::ceil(low / step - slack); k <= high / step + slack; ++k) ticks.push_back(k * step);
  return ticks;
}

std::string tickText(double value, double step) {
  const int decimals = step > 0 ? std::max(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0) : 3;
  const bool is_zero = std::abs(value) < step * 1e-6;
  if (decimals <= kMaxDecimals) return fixed(is_zero ? 0.0 : value, decimals);
  if (is_zero) return "0";
  const int digits = decimals + static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  char text[48];
  std::snprintf(text, sizeof text, "%.*e", std::clamp(digits, 0, 9), value);
  return text;
}

std::vector<Point> decimate(const std::vector<Point>& line, double x_low, double x_high, int columns) {
  if (columns < 1 || !(x_high > x_low) || line.size() <= 4 * static_cast<std::size_t>(columns)) return line;
  const auto columnOf = [&](const Point& point) { return std::floor((point.x - x_low) / (x_high - x_low) * columns); };
  std::vector<Point> kept;
  for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end) {
    const double column = columnOf(line[begin]);
    while (end < line.size() && columnOf(line[end]) == column) ++end;
    const auto lower = [&](std::size_t a, std::size_t b) { return line[a].y < line[b].y; };
    std::size_t lowest = begin, highest = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (lower(i, lowest)) lowest = i;
      if (lower(highest, i)) highest = i;
    }
    std::size_t wanted[] = {begin, lowest, highest, end - 1};
    std::sort(std::begin(wanted), std::end(wanted));
    const auto last = std::unique(std::begin(wanted), std::end(wanted));
    for (auto index = std::begin(wanted); index != last; ++index) kept.push_back(line[*index]);
  }
  return kept;
}

std::string touching(const std::vector<Band>& spans) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> names;
  for (const Band& span : spans)
    if (std::find(names.begin(), names.end(), span.label) == names.end()) names.push_back(span.label);
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) out += (i == 0 ? ", touching " : ", ") + names[i];
  return out + (names.size() > kNamed ? " and " + std::to_string(names.size() - kNamed) + " more" : "");
}

std::string escape(const std::string& text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace presa::svg
