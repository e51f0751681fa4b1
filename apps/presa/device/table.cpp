#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/common/terminal/text.h"
#include "apps/presa/device/characterise.h"

namespace presa::device {
namespace {

using terminal::format;
using terminal::Style;

const char* nameOf(Characteristic::Basis basis) {
  switch (basis) {
    case Characteristic::Basis::kFitted:
      return "fitted";
    case Characteristic::Basis::kFollows:
      return "follows";
    default:
      return "assumed";
  }
}

Style styleOf(const Characteristic& figure) {
  return !figure.compared() ? Style::kPlain : figure.agrees() ? Style::kGood : Style::kBad;
}

/// JSON has no infinity.
nlohmann::json numberOrNull(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

nlohmann::json toJson(const Characteristic& f) {
  return {{"name", f.name},
          {"unit", f.unit},
          {"printed_low", numberOrNull(f.printed_low)},
          {"printed_high", numberOrNull(f.printed_high)},
          {"here", numberOrNull(f.here)},
          {"tolerance", f.tolerance},
          {"basis", nameOf(f.basis)},
          {"agrees", f.compared() ? nlohmann::json(f.agrees()) : nlohmann::json()},
          {"note", f.note}};
}

nlohmann::json toJson(const DevicePlot& plot) {
  nlohmann::json lines = nlohmann::json::array();
  for (const PlotPanel& panel : plot.panels) {
    for (const PlotLine& line : panel.lines)
      lines.push_back({{"panel", panel.title}, {"label", line.label}, {"x", line.x}, {"y", line.y}});
  }
  return {{"name", plot.name}, {"title", plot.title}, {"x", plot.x_label}, {"y", plot.y_label}, {"lines", lines}};
}

}  // namespace

std::string numberText(double value) {
  return std::abs(value) >= 1000  ? format("%.0f", value)
         : std::abs(value) >= 100 ? format("%.1f", value)
                                  : format("%.3g", value);
}

std::string printedText(const Characteristic& f) {
  if (!f.compared()) return "–";
  if (std::isinf(f.printed_high)) return ">= " + numberText(f.printed_low);
  const auto plain = [](double value) { return format("%.4g", value); };
  return f.printed_low == f.printed_high ? plain(f.printed_low) : plain(f.printed_low) + " to " + plain(f.printed_high);
}

std::string verdictText(const Characteristic& f) {
  return (f.compared() ? f.agrees() ? "agrees, " : "DIFFERS, " : std::string()) + nameOf(f.basis);
}

std::string table(const Characterisation& c, bool color) {
  std::size_t width = 0;
  for (const Characteristic& f : c.figures) width = std::max(width, f.name.size());
  const int names = static_cast<int>(width);
  std::string out = terminal::styled(c.title, Style::kStrong, color) + ", beside " + c.source + "\n";
  out += terminal::styled(format("  %-*s  %10s  %8s  %s\n", names, "", "printed", "here", "unit"), Style::kDim, color);
  for (const Characteristic& f : c.figures) {
    const int dash = f.compared() ? 0 : 2;  // a dash is three bytes and one column
    out += format("  %-*s  %*s  %8s  %-5s  ", names, f.name.c_str(), 10 + dash, printedText(f).c_str(),
                  numberText(f.here).c_str(), f.unit == "1" ? "" : f.unit.c_str()) +
           terminal::styled(verdictText(f), styleOf(f), color) + "\n";
  }
  return out +
         "fitted: the model was made from this figure. follows: the model predicts it. assumed: it rests "
         "on\nunpublished numbers. All of these are figures of the model, not of a device.\n";
}

std::string json(const Characterisation& c) {
  nlohmann::json all{{"title", c.title}, {"source", c.source}};
  for (const Characteristic& f : c.figures) all["figures"].push_back(toJson(f));
  for (const Assumption& a : c.assumptions)
    all["assumptions"].push_back({{"name", a.name}, {"unit", a.unit}, {"value", a.value}, {"origin", a.origin}});
  for (const DevicePlot& plot : c.plots) all["plots"].push_back(toJson(plot));
  return all.dump(1) + "\n";
}

}  // namespace presa::device
