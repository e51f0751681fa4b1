#include <algorithm>
#include <cmath>

#include "apps/common/report/svg_time.h"

namespace presa::svg {
namespace {

std::string path(const std::vector<Point>& points, const Scale& x, const Scale& y, bool step, double detail) {
  std::string out;
  const Point* previous = nullptr;
  const auto columns = static_cast<int>((x.pixel_high - x.pixel_low) * detail);
  const std::vector<Point> kept = decimate(points, x.data_low, x.data_high, columns);
  for (const Point& point : kept) {
    const std::string at = px(x(point.x));
    if (!previous) {
      out += "M" + at + " " + px(y(point.y));
    } else if (!step) {
      out += "L" + at + " " + px(y(point.y));
    } else if (point.y != previous->y) {
      out += "H" + at + "V" + px(y(point.y));
    }
    previous = &point;
  }
  if (step && previous) out += "H" + px(x(points.back().x));
  return out;
}

/// The next sample is too far away, or there is none.
bool endsAt(const TimeFigure& figure, std::size_t i) {
  return i + 1 >= figure.time.size() || (figure.max_step > 0 && figure.time[i + 1] - figure.time[i] > figure.max_step);
}

/// A sample and the extremes up to the next one, in the order in which a monotone signal has them.
void addSample(const TimeFigure& figure, const Series& series, std::size_t i, std::vector<Point>& run) {
  const std::vector<double>& time = figure.time;
  run.push_back({time[i], series.y[i]});
  if (series.low.empty() || endsAt(figure, i)) return;
  const double low = series.low[i], high = series.high[i];
  if (!std::isfinite(low) || !std::isfinite(high) || low == high) return;
  const double next = std::isfinite(series.y[i + 1]) ? series.y[i + 1] : series.y[i];
  const bool rises = next >= series.y[i];
  const double third = (time[i + 1] - time[i]) / 3;
  run.push_back({time[i] + third, rises ? low : high});
  run.push_back({time[i] + 2 * third, rises ? high : low});
}

}  // namespace

std::string linePath(const TimeFigure& figure, const Series& series, const Scale& x, const Scale& y) {
  std::string out;
  std::vector<Point> run;
  const auto flush = [&] {
    if (!run.empty()) out += path(run, x, y, series.step, figure.detail);
    run.clear();
  };
  for (std::size_t i = 0; i < figure.time.size(); ++i) {
    const bool known = std::isfinite(series.y[i]);
    if (known) addSample(figure, series, i, run);
    if (!known || endsAt(figure, i)) flush();
  }
  flush();
  return out;
}

}  // namespace presa::svg
