#include "apps/common/findings_json.h"

#include <nlohmann/json.hpp>

namespace presa {
namespace {

nlohmann::json findingOf(const Diagnostic& diagnostic) {
  return {{"severity", diagnostic.severity == Diagnostic::Severity::kError ? "error" : "warning"},
          {"code", diagnostic.code},
          {"file", diagnostic.where.file},
          {"line", diagnostic.where.line},
          {"column", diagnostic.where.column},
          {"message", diagnostic.message},
          {"help", diagnostic.help}};
}

}  // namespace

nlohmann::json findingsJson(const std::string& file, const std::string& kind, const Diagnostics& diagnostics) {
  nlohmann::json findings = nlohmann::json::array();
  for (const Diagnostic& diagnostic : diagnostics.all()) findings.push_back(findingOf(diagnostic));
  nlohmann::json json = {{"file", file}, {"kind", kind}, {"valid", !diagnostics.hasErrors()}, {"findings", findings}};
  if (kind == "scene") json["scene"] = file;
  return json;
}

}  // namespace presa
