#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/stability/case.h"

namespace presa::stability {

/// One line of the result: a finding of a trial, with what it belongs to.
struct Row {
  std::string case_name;
  Parameters parameters;
  std::string method;
  Finding finding;
  Verdict expected = Verdict::kStable;
  std::string source;
  double seconds = 0;  ///< wall time of its trial
  std::string reason;  ///< of a failure
  bool worse() const { return finding.verdict > expected; }
};

/// case, parameters, method, verdict, metric, value, unit, bound, oracle, source, seconds, expected (and reason). A value
/// that is no number is null.
nlohmann::json toJson(const Row& row);

/// Findings through the pipe between a trial's process and this one.
std::string packFindings(const std::vector<Finding>& findings);
std::vector<Finding> unpackFindings(const std::string& text);

}  // namespace presa::stability
