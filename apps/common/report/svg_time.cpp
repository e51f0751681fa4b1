#include "apps/common/report/svg_time.h"
#include "apps/common/terminal/text.h"

#include <algorithm>

namespace presa::svg {
namespace {

constexpr double kTimeWidth = 1080, kNoLabels = 1064;             // [px]
constexpr double kTimeTop = 26, kTimeBottom = 40, kTimeGap = 44;  // above the first panel, below the last, between two
constexpr double kWideCharacter = 8.2;                            // of a short label, where it may not be cut
constexpr double kRow = 18;                                       // a row of names above the first panel
constexpr std::size_t kMaxEventRows = 3;                          // further events have a line but no name

/// Right edge of the plotting area, with room for the names of the curves.
double rightEdge(const TimeFigure& figure) {
  double widest = 0;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series)
      widest = std::max(widest, static_cast<double>(terminal::widthOf(endLabelOf(panel, series))) * kWideCharacter);
  }
  return widest > 0 ? kTimeWidth - widest - kSwatch - 14 : kNoLabels;
}

template <class Interval>
void clip(std::vector<Interval>& bands, const Scale& x) {
  for (Interval& band : bands) {
    band.begin = std::clamp(band.begin, x.data_low, x.data_high);
    band.end = std::clamp(band.end, x.data_low, x.data_high);
  }
  std::erase_if(bands, [](const Interval& band) { return !(band.end > band.begin); });
}

/// Bands, spans and events inside the axis. An event after the last sample is drawn at the end.
TimeFigure clipped(const TimeFigure& figure, const Scale& x) {
  TimeFigure shown = figure;
  clip(shown.bands, x);
  for (Panel& panel : shown.panels) clip(panel.spans, x);
  std::erase_if(shown.events, [&](const Event& event) { return !(event.time >= x.data_low); });
  for (Event& event : shown.events) event.time = std::min(event.time, x.data_high);
  return shown;
}

std::string bandLabels(const std::vector<Band>& bands, const Scale& x, double y) {
  std::string out;
  for (const Band& band : bands) {
    const double width = x(band.end) - x(band.begin);
    // a name that does not fit appears only in the tooltip and the read-out
    if (static_cast<double>(terminal::widthOf(band.label)) * kCharacterPx > width) continue;
    out += textAt(0.5 * (x(band.begin) + x(band.end)), y, "phase", escape(band.label));
  }
  return out;
}

/// A line through all panels at each event, with its time and name above them, on the side with more room.
std::string eventMarks(const std::vector<Event>& events, const Scale& x, double top, double bottom) {
  std::string out;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double at = x(events[i].time);
    const std::string name = tickText(events[i].time, 1e-3) + " s: " + events[i].label;
    const bool named = i<kMaxEventRows, left = at> 0.5 * (x.pixel_low + x.pixel_high);
    const double y = top + kRow * static_cast<double>(i);
    out += "<line class=\"event\" x1=\"" + px(at) + "\" y1=\"" + px(named ? y - 11 : top) + "\" x2=\"" + px(at) +
           "\" y2=\"" + px(bottom) + "\"><title>" + escape(name) + "</title></line>\n";
    if (!named) continue;
    const std::size_t unnamed = i + 1 == kMaxEventRows ? events.size() - kMaxEventRows : 0;
    const std::string more = unnamed > 0 ? " (and " + std::to_string(unnamed) + " more)" : "";
    const double room = left ? at - x.pixel_low : x.pixel_high - at;
    out += textAt(left ? at - 5 : at + 5, y, left ? "event-label halo end" : "event-label halo",
                  escape(shortened(name + more, room - 10)));
  }
  return out;
}

std::string xLabels(const std::string& label, const Scale& x, double bottom) {
  std::string out;
  const std::vector<double> ticks = niceTicks(x.data_low, x.data_high, kTimeTicks);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 0;
  for (const double t : ticks) out += textAt(x(t), bottom + 16, "tick xtick", tickText(t, step));
  return out + textAt(0.5 * (x.pixel_low + x.pixel_high), bottom + 34, "tick xtick", escape(label));
}

}  // namespace

std::string shortened(const std::string& text, double px) {
  const auto room = static_cast<std::size_t>(std::max(px / kCharacterPx, 2.0));
  if (terminal::widthOf(text) <= room) return text;
  std::size_t bytes = 0;
  for (std::size_t letters = 0; bytes < text.size(); ++bytes)
    if ((text[bytes] & 0xC0) != 0x80 && ++letters == room) break;
  return text.substr(0, bytes) + "…";
}

std::string render(const TimeFigure& figure) {
  if (figure.time.size() < 2) return "<p class=\"empty\">No samples to plot.</p>\n";
  const Scale x{figure.time.front(), figure.time.back(), kTimeLeft, rightEdge(figure)};
  const TimeFigure shown = clipped(figure, x);
  const double events_top = kTimeTop - 14 + (shown.bands.empty() ? 0 : kRow);
  const double event_rows = static_cast<double>(std::min(shown.events.size(), kMaxEventRows));
  const double first_top = kTimeTop + (shown.bands.empty() ? 0 : 20) + kRow * event_rows;
  std::string panels;
  double top = first_top;
  for (const Panel& panel : shown.panels) {
    panels += panelBody(shown, panel, x, top);
    top += panel.height + kTimeGap;
  }
  const double bottom = top - kTimeGap;
  const std::string picture = "<svg viewBox=\"0 0 " + px(kTimeWidth) + " " + px(bottom + kTimeBottom) +
                              "\" role=\"img\" aria-label=\"" + escape(figure.title) + "\">\n" +
                              bandLabels(shown.bands, x, 12) + panels +
                              eventMarks(shown.events, x, events_top, bottom) + xLabels(figure.x_label, x, bottom) +
                              lineFromTo(kTimeLeft, first_top, kTimeLeft, bottom, "cursor") + "</svg>";
  const std::string data =
      "<div class=\"readout\" hidden></div><script type=\"application/json\">" + readoutData(shown, x) + "</script>";
  return withSaveLinks("plot", picture, data, figure.title, csvOf(shown));
}

}  // namespace presa::svg
