#include "apps/presa/device/findings.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/common/terminal/text.h"
#include "framework/scene/manifest.h"
#include "framework/session/session.h"

namespace presa::device {
namespace {

using terminal::Style;
using terminal::styled;
using Verdict = DeviceFinding::Verdict;

const char* wordOf(Verdict verdict) {
  if (verdict == Verdict::kFine) return "good";
  return verdict == Verdict::kWarning ? "warning" : "problem";
}

Style styleOf(Verdict verdict) {
  if (verdict == Verdict::kFine) return Style::kGood;
  return verdict == Verdict::kWarning ? Style::kWarning : Style::kBad;
}

}  // namespace

std::vector<std::string> drivers() {
  std::vector<std::string> names;
  for (const Manifest& manifest : manifests())
    if (manifest.kind == PluginKind::kDevice) names.push_back(manifest.name);
  return names;
}

Report ask(const DeviceBinding& binding) {
  const Manifest* manifest = findManifest(binding.driver);
  Report report{binding.driver, manifest == nullptr ? "" : manifest->about, {}};
  try {
    const DevicePlugin& driver = devicePlugin(binding.driver);
    if (driver.diagnose != nullptr)
      report.findings = driver.diagnose(binding);
    else
      report.findings.push_back({Verdict::kFine, 0, "", "simulated: needs no hardware", ""});
  } catch (const InputError& error) {
    for (const Diagnostic& found : error.diagnostics().all())
      report.findings.push_back({Verdict::kProblem, found.code, "", found.message, found.help});
  }
  return report;
}

bool hasProblem(const std::vector<Report>& reports) {
  return std::any_of(reports.begin(), reports.end(), [](const Report& report) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [](const DeviceFinding& finding) { return finding.verdict == Verdict::kProblem; });
  });
}

std::string text(const std::vector<Report>& reports, bool color) {
  std::string out;
  for (const Report& report : reports) {
    out += styled(report.name, Style::kStrong, color) + (report.summary.empty() ? "" : ": " + report.summary) + "\n";
    for (const DeviceFinding& finding : report.findings) {
      out += "  " + styled(terminal::format("%-8s", wordOf(finding.verdict)), styleOf(finding.verdict), color);
      if (finding.code != 0)
        out += terminal::format("[%c%d] ", finding.verdict == Verdict::kProblem ? 'E' : 'W', finding.code);
      out += (finding.device.empty() ? "" : finding.device + ": ") + finding.message + "\n";
      if (!finding.help.empty()) out += "          " + finding.help + "\n";
    }
  }
  return out;
}

std::string json(const std::vector<Report>& reports) {
  auto list = nlohmann::json::array();
  for (const Report& report : reports) {
    auto findings = nlohmann::json::array();
    for (const DeviceFinding& finding : report.findings)
      findings.push_back({{"verdict", wordOf(finding.verdict)},
                          {"code", finding.code},
                          {"device", finding.device},
                          {"message", finding.message},
                          {"help", finding.help}});
    list.push_back({{"name", report.name}, {"summary", report.summary}, {"findings", findings}});
  }
  return list.dump(2) + "\n";
}

}  // namespace presa::device
