// What the plots of a run show: every figure was wrong once, as the comments say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "apps/common/number_text.h"
#include "apps/common/report/fault_events.h"
#include "apps/common/report/figures.h"
#include "apps/common/report/report.h"
#include "apps/common/report/svg_time.h"
#include "tests/framework/record/monitor/synthetic_run.h"

namespace presa {
namespace {

using svg::Scale;

/// Two fingers hold the cube for 2 s with a rendered force of 6 N, or one that varies at 80 Hz; from 1 s on the devices
/// get nothing.
struct HeldRun {
  test::Feed feed{2, 10, 125};
  RunResult result;

  explicit HeldRun(bool varies = false, bool fault = true) {
    for (int i = 0; i < 2000; ++i) {
      const double force = varies ? 3 + 2 * std::sin(2 * std::numbers::pi * 80 * i * 1e-3) : 6;
      for (std::size_t f = 0; f < 2; ++f) {
        feed.touch(f, ContactMode::kStick, force, 1);
        feed.contact.fingers[f].nhat_W = Vec3::UnitX();
        feed.command.f_H_W[f] = fault && i >= 1000 ? Vec3(0, 0, 0) : feed.contact.fingers[f].f_H_W;
      }
      feed.tick();
    }
    result.world = feed.world;
    if (fault) result.faults = {{1.0, "thumb: device disconnected; the force went to zero and stays there"}};
    takeMonitor(feed.monitor, result);
  }
};

const svg::Series& seriesOf(const svg::TimeFigure& figure, const std::string& label) {
  for (const svg::Panel& panel : figure.panels)
    for (const svg::Series& series : panel.series)
      if (series.label == label) return series;
  throw std::out_of_range(label);
}

/// Min and max of y in the path of a series, in data units: a pixel is a thousandth.
std::pair<double, double> drawnRange(const svg::TimeFigure& figure, const svg::Series& series) {
  const Scale x{figure.time.front(), figure.time.back(), 0, 300}, y{0, 1, 0, 1000};
  const std::string path = svg::linePath(figure, series, x, y);
  double low = 1e9, high = -1e9;
  const std::regex point("[ML][-0-9.]+ ([-0-9.]+)");
  for (std::sregex_iterator it(path.begin(), path.end(), point), end; it != end; ++it) {
    const double value = std::stod((*it)[1]) / 1000;
    low = std::min(low, value), high = std::max(high, value);
  }
  return {low, high};
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// 80 Hz from samples at 125 Hz was drawn as another, smaller vibration.
TEST(ReportPlots, DrawAFastSignalWithItsAmplitude) {
  const HeldRun run(true, false);
  const svg::TimeFigure figure = pathFigure(run.result, {}, 0);
  for (const char* label : {"normal, commanded", "normal, rendered"}) {
    const auto [low, high] = drawnRange(figure, seriesOf(figure, label));
    EXPECT_NEAR(high - low, 4, 0.04) << label;
    EXPECT_NEAR(high, 5, 0.02) << label;
  }
}

// The page of a fault showed the rendered force where the device got none.
TEST(ReportPlots, DrawWhatTheDeviceGotAndMarkTheFault) {
  const HeldRun run;
  const svg::TimeFigure figure = pathFigure(run.result, {}, 0);
  const svg::Series &commanded = seriesOf(figure, "normal, commanded"),
                    &rendered = seriesOf(figure, "normal, rendered");
  for (std::size_t i = 0; i < figure.time.size(); ++i) {
    EXPECT_EQ(commanded.y[i], figure.time[i] < 1 ? 6 : 0) << figure.time[i];
    EXPECT_EQ(commanded.high[i], figure.time[i] < 1 ? 6 : 0) << figure.time[i];
    EXPECT_EQ(rendered.y[i], 6);
  }
  ASSERT_EQ(figure.events.size(), 1u);
  EXPECT_EQ(figure.events[0].time, 1);
  EXPECT_EQ(figure.panels[1].title, "Grip force, touching cube");
  ASSERT_EQ(figure.panels[2].spans.size(), 1u);
  EXPECT_EQ(figure.panels[2].spans[0].label, "cube");

  const std::string page = reportHtml(run.result);
  EXPECT_EQ(countOf(page, "<line class=\"event\""), 2u) << "one line through the panels of each finger";
  EXPECT_EQ(countOf(page, ">1.000 s: thumb: device disconnected</text>"), 2u);
  EXPECT_LT(page.find("<path class=\"line thin\""), page.find("<path class=\"line force\"")) << "rendered lies behind";
}

// Headings without anything below them.
TEST(ReportPlots, LeaveOutFingersAndBodiesThatAreNotThere) {
  HeldRun run;
  EXPECT_NE(reportHtml(run.result).find("<h2>Friction</h2>"), std::string::npos);
  run.result.contact_points.clear();
  const std::string page = reportHtml(run.result);
  for (const char* heading : {"<h2>Position", "<h2>Friction", "<h2>Contact points"})
    EXPECT_EQ(page.find(heading), std::string::npos) << heading;
  EXPECT_NE(page.find("<h2>Objects</h2>"), std::string::npos);
  run.result.objects.clear();
  EXPECT_EQ(reportHtml(run.result).find("<h2>Objects</h2>"), std::string::npos);
}

// Vertical lines of the grid lay over the curves and titles, and cut them.
TEST(ReportPlots, DrawTheGridUnderTheCurves) {
  svg::TimeFigure figure{.title = "f", .time = {0, 1, 2}};
  figure.panels = {{.title = "Force", .unit = "N", .series = {{"force", "force", {1, 2, 1}}}}};
  const std::string html = svg::render(figure), drawn = html.substr(0, html.find("</svg>"));
  EXPECT_GT(countOf(drawn, "<line class=\"grid\""), 6u);
  EXPECT_LT(drawn.rfind("<line class=\"grid\""), drawn.find("<path class=\"line"));
  EXPECT_NE(drawn.find("class=\"end-label\""), std::string::npos) << "the curve is named at its end";
}

// While the loop stands still nothing is known: a line across the gap would claim a force.
TEST(ReportPlots, InterruptCurvesWhereNothingWasSampled) {
  svg::TimeFigure figure{.title = "f", .time = {0, 1, 2, 8, 9}};
  figure.panels = {{.title = "Force", .series = {{"force", "force", {1, 1, 1, 5, 5}}}}};
  const auto pieces = [&] {
    return countOf(svg::linePath(figure, figure.panels[0].series[0], {0, 9, 0, 900}, {0, 5, 500, 0}), "M");
  };
  EXPECT_EQ(pieces(), 1u);
  figure.max_step = 2;
  EXPECT_EQ(pieces(), 2u);
}

// Two fingers that lose their device at once made two lines of text over each other's panels.
TEST(ReportPlots, TellOneFaultOfSeveralFingersOnce) {
  std::vector<svg::Event> events;
  addFault(1, "thumb: device lost; the force went to zero", events);
  addFault(1, "index: device lost; the force went to zero", events);
  addFault(1, "index: over-speed", events);
  addFault(2, "index: device lost", events);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].label, "thumb, index: device lost");
  EXPECT_EQ(events[1].label, "index: over-speed");
  EXPECT_EQ(events[2].time, 2);
}

// Names that lie over each other cannot be read.
TEST(ReportPlots, NameCurvesApartFromEachOther) {
  svg::TimeFigure figure{.title = "f", .time = {0, 1}};
  figure.panels = {{.title = "F", .series = {{"a", "x", {1, 1}}, {"b", "x", {1, 1}}, {"c", "x", {1, 0}}}}};
  const std::string html = svg::render(figure);
  const std::regex label("class=\"end-label\" x=\"[0-9.]+\" y=\"([0-9.]+)\"");
  std::vector<double> at;
  for (std::sregex_iterator it(html.begin(), html.end(), label), end; it != end; ++it)
    at.push_back(std::stod((*it)[1]));
  ASSERT_EQ(at.size(), 3u);
  for (std::size_t i = 1; i < at.size(); ++i) EXPECT_GE(at[i] - at[i - 1], 14);
}

TEST(ReportPlots, AreSavedAsPictureAndAsNumbersWithUnits) {
  const HeldRun run;
  const std::string page = reportHtml(run.result);
  EXPECT_EQ(countOf(page, "href=\"data:image/svg+xml;base64,"), 4u) << "two time figures, two of friction";
  EXPECT_EQ(countOf(page, "href=\"data:text/csv;base64,"), 4u);
  const svg::TimeFigure figure = pathFigure(run.result, {}, 0);
  const std::string csv = svg::csvOf(figure).text();
  EXPECT_EQ(csv.find("\"time [s]\",\"Height: finger [m] min\",\"Height: finger [m] max\""), 0u) << csv.substr(0, 200);
  EXPECT_NE(csv.find("\"Grip force, touching cube: normal, commanded [N] max\""), std::string::npos);
  EXPECT_EQ(countOf(csv, "\n"), 251u);
  const std::string html = svg::render(figure);
  const std::string picture =
      svg::standalone(html.substr(html.find("<svg"), html.find("</svg>") + 6 - html.find("<svg")));
  EXPECT_EQ(picture.find("var("), std::string::npos) << "other programs know no CSS variables";
  EXPECT_NE(picture.find("svg .force { stroke: #"), std::string::npos);
}

// "-0.0000" was printed where a body lay a nanometre below the origin.
TEST(NumberText, HasNoNegativeZero) {
  EXPECT_EQ(fixed(-1e-9, 4), "0.0000");
  EXPECT_EQ(fixed(-0.0, 0), "0");
  EXPECT_EQ(fixed(-0.00006, 4), "-0.0001");
  EXPECT_EQ(significant(-0.0, 3), "0");
  EXPECT_EQ(significant(-1e-9, 3), "-1e-09");
  HeldRun run;
  run.result.objects[0].summary.final = Vec3(-1e-9, -1e-12, 0.035);
  EXPECT_EQ(reportHtml(run.result).find("-0.0000"), std::string::npos);
}

// Provenance without a date, a commit or a machine does not say where the figures come from.
TEST(ReportPlots, SayWhenAndWhereTheRunWas) {
  HeldRun run;
  run.result.started = "2026-03-01 10:30:00 +0100";
  run.result.version = "0.1.0";
  const std::string page = reportHtml(run.result);
  EXPECT_NE(page.find("<td>started</td><td>2026-03-01 10:30:00 +0100</td>"), std::string::npos);
  EXPECT_TRUE(std::regex_search(page, std::regex("<td>machine</td><td>[^<]+ cores, [^<]+</td>")));
  EXPECT_TRUE(
      std::regex_search(page, std::regex("<td>Presa version</td><td>0\\.1\\.0(, commit [0-9a-f]{7,}(-dirty)?)?</td>")));
}

// A steep ray ran through the words of the legend; a curve without points had an entry, and an empty path.
TEST(ReportPlots, KeepTheLegendOfFrictionClearOfTheRays) {
  svg::ScatterFigure figure;
  figure.clouds = {{"stick", "stick", {{1, 0.1}, {2, 0.2}}}, {"slip", "slip", {}}};
  figure.rays = {{"slip line", "static", 3}};
  const std::string html = svg::render(figure), drawn = html.substr(0, html.find("</svg>"));
  const auto numberAfter = [&](std::size_t at, const std::string& attribute) {
    return std::stod(drawn.substr(drawn.find(attribute, at) + attribute.size()));
  };
  const double ray_top = numberAfter(drawn.find("<line class=\"ray static\""), "y2=\"");
  EXPECT_LT(numberAfter(drawn.rfind("<text class=\"legend\""), " y=\""), ray_top)
      << "the last line of the legend is above the ray's end";
  EXPECT_EQ(drawn.find("d=\"\""), std::string::npos);
  EXPECT_EQ(countOf(drawn, "class=\"legend\""), 2u);
}

}  // namespace
}  // namespace presa
