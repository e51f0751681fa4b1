#include "apps/common/report/recording_page.h"

#include <algorithm>
#include <cmath>

#include "apps/common/number_text.h"
#include "apps/common/report/fault_events.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "framework/device/output_stage.h"
#include "framework/scene/xml/xml.h"

namespace presa {
namespace {

using terminal::format;

struct Bit {
  std::uint32_t bit;
  const char* name;
};
// bits worth listing; clipping, slew and damping change too often
constexpr Bit kBits[] = {{kOutputNotFinite, "force not a number"},
                         {kOutputLost, "device lost"},
                         {kOutputSpeed, "hand too fast"},
                         {kOutputOther, "forces of the other fingers off"},
                         {kOutputGap, "stood still"},
                         {kOutputWatchdog, "information too old"},
                         {kOutputFading, "fading"},
                         {kOutputWarm, "motors warm"},
                         {kOutputOverload, "past the continuous rating"}};

std::string wordsOf(std::uint32_t status) {
  std::string words;
  for (const Bit& bit : kBits) {
    if ((status & bit.bit) != 0) words += (words.empty() ? "" : ", ") + std::string(bit.name);
  }
  return words.empty() ? "nothing held back" : words;
}

/// Magnitude of the vector NAME_x, NAME_y, NAME_z at every tick.
std::vector<double> magnitude(const RecordedTable& table, const std::string& name) {
  const auto &x = table.values(name + "_x"), &y = table.values(name + "_y"), &z = table.values(name + "_z");
  std::vector<double> out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) out[i] = std::hypot(x[i], y[i], z[i]);
  return out;
}

constexpr double kFullFigures = 3;    // of more fingers, each has fewer points, so that a page of eight has 5 MB
constexpr double kTicksMissing = 20;  // in a row: the loop stood still

/// The bodies that the finger touched, by name.
std::vector<svg::Band> touched(const RecordedSamples& samples, const RecordedTable& finger,
                               const std::vector<std::string>& bodies) {
  const std::vector<double>&mode = finger.values("mode"), &body = finger.values("body");
  std::vector<svg::Band> spans;
  double before = -1;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const double now = mode[i] > 0 ? body[i] : -1;
    if (i > 0 && samples.time[i] - samples.time[i - 1] > kTicksMissing * samples.haptic_period) before = -1;
    if (before >= 0) spans.back().end = samples.time[i];
    if (now >= 0 && now != before) {
      const auto index = static_cast<std::size_t>(now);
      const std::string name = index < bodies.size() ? bodies[index] : "body " + fixed(now, 0);
      spans.push_back({name, samples.time[i], samples.time[i]});
    }
    before = now;
  }
  return spans;
}

svg::TimeFigure figureOf(const RecordedSamples& samples, const RecordedTable& finger,
                         const std::vector<std::string>& bodies) {
  svg::TimeFigure figure;
  figure.title = "Force, penetration, speed and place of " + finger.name + " over time";
  figure.time = samples.time;
  figure.max_step = kTicksMissing * samples.haptic_period;
  figure.detail = std::min(1.0, kFullFigures / static_cast<double>(samples.fingers.size()));
  figure.events = faultEvents(samples.faults);
  const std::vector<svg::Band> spans = touched(samples, finger, bodies);
  svg::Panel force{.title = "Force" + svg::touching(spans), .unit = "N", .height = 170, .from_zero = true};
  force.series.push_back({"rendered", "thin", magnitude(finger, "f_rendered_W")});
  force.series.push_back({"commanded", "force", magnitude(finger, "f_command_W")});
  svg::Panel depth{.title = "Penetration", .unit = "m", .height = 110, .from_zero = true};
  depth.series.push_back({"depth", "object", finger.values("depth")});
  svg::Panel speed{.title = "Speed", .unit = "m/s", .height = 110, .from_zero = true};
  speed.series.push_back({"finger", "finger", magnitude(finger, "v_WH")});
  svg::Panel place{.title = "Place", .unit = "m", .height = 150};
  place.series.push_back({"x", "finger", finger.values("p_WH_x")});
  place.series.push_back({"y", "proxy", finger.values("p_WH_y")});
  place.series.push_back({"z", "object", finger.values("p_WH_z")});
  svg::Panel state{.title = "Contact state", .height = 84, .names = {"none", "stick", "slip"}, .spans = spans};
  state.series.push_back({"state", "state", finger.values("mode"), true});
  svg::Panel sample{.title = "Sample", .height = 50, .names = {"none", "good", "lost"}};
  sample.series.push_back({"sample", "state", finger.values("valid"), true});
  figure.panels = {std::move(force), std::move(depth), std::move(speed),
                   std::move(place), std::move(state), std::move(sample)};
  return figure;
}

std::string list(const std::vector<std::string>& lines) {
  std::string html = "<ul>\n";
  for (const std::string& line : lines) html += "<li>" + svg::escape(line) + "</li>\n";
  return html + "</ul>\n";
}

}  // namespace

std::vector<std::string> statusTimeline(const RecordedSamples& samples) {
  std::uint32_t known = 0;
  for (const Bit& bit : kBits) known |= bit.bit;
  std::vector<std::string> lines;
  std::uint32_t before = ~0u;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const std::uint32_t now = samples.status[i] & known;
    if (now != before) lines.push_back(format("%.3f s: ", samples.time[i]) + wordsOf(now));
    before = now;
  }
  return lines;
}

std::vector<std::string> bodyNames(const std::string& scene_xml) {
  Diagnostics diagnostics;
  std::vector<std::string> names;
  if (const auto document = xml::Document::parse(scene_xml, "scene", diagnostics)) {
    for (const xml::Element& body : document->root().children("body")) names.push_back(body.attribute("name"));
  }
  return names;
}

std::string recordingPage(const std::string& file, const RecordedSamples& samples,
                          const std::vector<std::string>& bodies, const PagePart& part) {
  std::string html = page::head("Presa: " + file, part.style) + "<h1>" + svg::escape(file) + "</h1>\n";
  html += "<p>Scene " + svg::escape(samples.scene_file) + ", " + svg::escape(samples.start_utc) +
          format(", %.3f to %.3f s, %zu haptic ticks.</p>\n", samples.time.front(), samples.time.back(),
                 samples.time.size());
  html += part.html;
  if (!samples.faults.empty()) html += "<h2>What went wrong</h2>\n" + list(samples.faults);
  html += "<h2>What the output stages did</h2>\n" + list(statusTimeline(samples));
  for (const RecordedTable& finger : samples.fingers)
    html += "<h2>" + svg::escape(finger.name) + "</h2>\n" + svg::render(figureOf(samples, finger, bodies));
  if (!samples.fingers.empty())
    html +=
        "<p class=\"caption\">Commanded: after the output stage, as sent to the device. Rendered: before it, thin. "
        "Every haptic tick is drawn; a curve is interrupted where no tick ran.</p>\n";
  return html + part.end + page::tail();
}

}  // namespace presa
