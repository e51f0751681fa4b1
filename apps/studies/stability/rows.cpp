#include "apps/studies/stability/rows.h"

#include <cmath>
#include <limits>

namespace presa::stability {
namespace {

using nlohmann::json;

double numberOf(const json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

json pack(const Finding& finding) {
  json curves = json::array();
  for (const Curve& curve : finding.curves) curves.push_back({{"label", curve.label}, {"x", curve.x}, {"y", curve.y}});
  return {{"metric", finding.metric}, {"value", finding.value},   {"unit", finding.unit},
          {"bound", finding.bound},   {"oracle", finding.oracle}, {"verdict", static_cast<int>(finding.verdict)},
          {"plot_x", finding.plot_x}, {"plot_y", finding.plot_y}, {"curves", curves}};
}

Finding unpack(const json& packed) {
  Finding finding;
  finding.metric = packed.at("metric");
  finding.value = numberOf(packed.at("value"));
  finding.unit = packed.at("unit");
  finding.bound = packed.at("bound");
  finding.oracle = packed.at("oracle");
  finding.verdict = static_cast<Verdict>(packed.at("verdict").get<int>());
  finding.plot_x = packed.at("plot_x");
  finding.plot_y = packed.at("plot_y");
  for (const json& curve : packed.at("curves")) {
    Curve line{curve.at("label"), {}, {}};
    for (const json& x : curve.at("x")) line.x.push_back(numberOf(x));
    for (const json& y : curve.at("y")) line.y.push_back(numberOf(y));
    finding.curves.push_back(std::move(line));
  }
  return finding;
}

}  // namespace

json toJson(const Row& row) {
  json parameters = json::object();
  for (const auto& [name, value] : row.parameters) parameters[name] = value;
  json line{{"case", row.case_name},
            {"parameters", parameters},
            {"method", row.method},
            {"verdict", toString(row.finding.verdict)},
            {"metric", row.finding.metric},
            {"value", row.finding.value},
            {"unit", row.finding.unit},
            {"bound", row.finding.bound},
            {"oracle", row.finding.oracle},
            {"source", row.source},
            {"seconds", std::round(row.seconds * 1000) / 1000},
            {"expected", toString(row.expected)}};
  if (!row.reason.empty()) line["reason"] = row.reason;
  return line;
}

std::string packFindings(const std::vector<Finding>& findings) {
  json all = json::array();
  for (const Finding& finding : findings) all.push_back(pack(finding));
  return all.dump();
}

std::vector<Finding> unpackFindings(const std::string& text) {
  std::vector<Finding> findings;
  for (const json& packed : json::parse(text)) findings.push_back(unpack(packed));
  return findings;
}

}  // namespace presa::stability
