#include "apps/common/report/report.h"

#include <optional>

#include "apps/common/atomic_file.h"
#include "apps/common/file_text.h"
#include "apps/common/grasp_figures.h"
#include "apps/common/report/base64.h"
#include "apps/common/report/figures.h"
#include "apps/common/report/joint_section.h"
#include "apps/common/report/page.h"
#include "apps/common/report/printed_section.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/report/tables.h"
#include "apps/common/verdict.h"

namespace presa {
namespace {

using svg::escape;

std::string verdictBlock(const RunResult& result) {
  const Verdict verdict = verdictOf(result);
  const char* css_class = verdict.outcome == Verdict::Outcome::kGood  ? "good"
                          : verdict.outcome == Verdict::Outcome::kBad ? "bad"
                                                                      : "neutral";
  std::string out = "<div class=\"verdict " + std::string(css_class) + "\"><b>" + escape(verdict.headline) + "</b>\n";
  for (const std::string& detail : verdict.details) out += "<p>" + escape(detail) + "</p>\n";
  for (const std::string& warning : verdict.warnings)
    out += "<p class=\"warning\">Warning: " + escape(warning) + "</p>\n";
  return out + "</div>\n";
}

std::string graspSection(const RunResult& result, const std::optional<GraspFigures>& grasp) {
  if (!grasp) return {};
  return html::graspTiles(*grasp) + "<h2>Grasp</h2>\n" + html::graspTable(result, *grasp) +
         "<p class=\"caption\">Offset range: diagonal of the box the proxy kept to in the object's own coordinates "
         "while it was held. "
         "Share of weight: mean upward force over m g / n. Ripple: peak to peak over mean of the normal force in the "
         "last 2 s of "
         "the hold. The slip limit holds for n equal fingers on upright faces.</p>\n";
}

std::string pathSection(const RunResult& result, const std::optional<GraspFigures>& grasp) {
  if (!result.trace || result.contact_points.empty()) return {};
  std::string out = "<h2>Position, grip force and contact state</h2>\n";
  for (std::size_t f = 0; f < result.contact_points.size(); ++f) {
    out += "<h3>" + escape(result.contact_points[f].name) + "</h3>\n" + svg::render(pathFigure(result, grasp, f));
  }
  return out +
         "<p class=\"caption\">Commanded: after the output stage, as sent to the device. Rendered: before it, thin. "
         "Without contact there is no normal, and all force counts as its normal part. Height is along z. While the "
         "object is held, finger and object keep a constant "
         "difference; once it "
         "slips they part. States: 0 no contact, 1 stick, 2 slip; the strip above them names the touched body.</p>\n";
}

bool everTouched(const RunResult::ContactPoint& point) {
  const auto in = [&](ContactMode mode) { return point.summary.seconds[static_cast<std::size_t>(mode)]; };
  return in(ContactMode::kStick) + in(ContactMode::kSlip) > 0;
}

std::string frictionSection(const RunResult& result, const std::optional<GraspFigures>& grasp) {
  if (!result.trace) return {};
  std::string plots;
  for (std::size_t f = 0; f < result.contact_points.size(); ++f) {
    if (!everTouched(result.contact_points[f])) continue;
    plots += "<div><h3>" + escape(result.contact_points[f].name) + "</h3>\n" +
             svg::render(frictionFigure(result, grasp, f)) + "</div>\n";
  }
  if (plots.empty()) return {};
  return "<h2>Friction</h2>\n<div class=\"pair\">\n" + plots +
         "</div>\n<p class=\"caption\">A contact sticks below the slip line and slides along the dynamic one.</p>\n";
}

std::string filesSection(const RunResult& result) {
  if (result.load_warnings.empty()) return {};
  std::string out = "<h2>Warnings of the files</h2>\n<ul>\n";
  for (const std::string& warning : result.load_warnings) out += "<li>" + escape(warning) + "</li>\n";
  return out + "</ul>\n";
}

std::string screenshotSection(const RunResult& result) {
  if (result.screenshot.empty()) return {};
  const std::string bytes = contentsOf(result.screenshot);
  if (bytes.empty())
    return "<p class=\"fault\">The screenshot " + escape(result.screenshot) + " could not be read.</p>\n";
  return "<h2>Picture</h2>\n<img alt=\"The scene during the run\" src=\"data:image/png;base64," + base64(bytes) +
         "\">\n";
}

}  // namespace

std::string reportHtml(const RunResult& result) {
  const Scene& scene = result.world->scene;
  const std::optional<GraspFigures> grasp = graspFigures(result);
  std::string out = page::head(scene.name + " – Presa");
  out += "<h1>" + escape(scene.name) + "</h1>\n<p class=\"lead\">" + escape(scene.description) + "</p>\n";
  out +=
      verdictBlock(result) + graspSection(result, grasp) + pathSection(result, grasp) + frictionSection(result, grasp);
  if (!result.contact_points.empty()) out += "<h2>Contact points</h2>\n" + html::contactTable(result);
  if (!result.tools.empty()) out += "<h2>Tools</h2>\n" + html::toolTable(result);
  if (!result.objects.empty()) out += "<h2>Objects</h2>\n" + html::objectTable(result);
  out += html::jointSection(result.joints);
  out += html::printedSection(result);
  out += "<h2>Rates</h2>\n" + html::rateTable(result);
  out += "<h2>Faults and notes</h2>\n" + html::faultsAndNotes(result);
  out += filesSection(result) + screenshotSection(result);
  out += "<h2>Provenance</h2>\n" + html::provenance(result);
  return out + page::tail();
}

void writeReport(const RunResult& result, const std::string& path) { writeFileAtomically(path, reportHtml(result)); }

}  // namespace presa
