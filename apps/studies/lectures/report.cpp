#include "apps/studies/lectures/report.h"

#include <cmath>

#include "apps/common/report/html.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"

namespace presa::lectures {
namespace {

using svg::escape;
using terminal::format;

svg::WorkFigure figureOf(const Lecture& lecture) {
  svg::WorkFigure figure;
  figure.title = lecture.title;
  figure.x_label = lecture.x_label;
  figure.legend = "● measured  — " + lecture.oracle;
  figure.y_label = lecture.y_label;
  for (const Point& point : lecture.points) {
    const bool good = std::abs(point.off()) <= lecture.tolerance;
    figure.points.push_back(
        {{point.x, point.measured},
         point.x,
         point.x,
         format("%s: measured %.4g, closed form %.4g", point.knob.c_str(), point.measured, point.oracle),
         good ? "front" : "other"});
    figure.front.push_back({point.x, point.oracle});
  }
  return figure;
}

std::string tableOf(const Lecture& lecture) {
  std::string rows;
  for (const Point& point : lecture.points) {
    rows += html::row({escape(point.knob), format("%.4g", point.x), format("%.4g", point.measured),
                       format("%.4g", point.oracle), format("%.4g", point.reference()),
                       format("%+.2f %%", 100 * point.off())});
  }
  return html::table({escape(lecture.knob), escape(lecture.x_label), escape(lecture.y_label), escape(lecture.oracle),
                      escape(lecture.exact.empty() ? "exactly" : lecture.exact), "measured is off by"},
                     rows);
}

}  // namespace

std::string picture(const Lecture& lecture) { return page::picture(svg::render(figureOf(lecture)), lecture.title); }

std::string reportHtml(const Lecture& lecture, const std::string& command) {
  std::string out = page::head(lecture.title + " – Presa") + "<h1>" + escape(lecture.title) +
                    "</h1>\n<p class=\"lead\">" + escape(lecture.description) + "</p>\n" +
                    svg::render(figureOf(lecture)) + "<div class=\"verdict " + (lecture.holds() ? "good" : "bad") +
                    "\">\n";
  for (const std::string& sentence : lecture.sentences) out += "<p>" + escape(sentence) + "</p>\n";
  return out + "</div>\n<h2>Figures</h2>\n" + tableOf(lecture) +
         "<p class=\"caption\">Lockstep virtual time, scene <code>experiments/stability/scenes/haptic_wall.xml</code>, "
         "Presa " +
         escape(versionText()) + ".</p>\n<h3>Repeat this study</h3>\n<pre><code>" + escape(command) +
         "</code></pre>\n" + page::tail();
}

std::string toCsv(const Lecture& lecture) {
  const auto quoted = [](const std::string& text) { return "\"" + text + "\""; };
  std::string out = quoted(lecture.knob) + "," + quoted(lecture.x_label) + "," +
                    quoted("measured: " + lecture.y_label) + "," + quoted(lecture.oracle) + "," +
                    quoted(lecture.exact.empty() ? "exactly" : lecture.exact) + "\n";
  for (const Point& point : lecture.points) {
    out +=
        quoted(point.knob) + format(",%.9g,%.9g,%.9g,%.9g\n", point.x, point.measured, point.oracle, point.reference());
  }
  return out;
}

}  // namespace presa::lectures
