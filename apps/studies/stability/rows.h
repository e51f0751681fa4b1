#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/stability/case.h"

namespace presa::stability {

/// One line of the result: a finding of a trial, with its case, parameters and method.
struct Row {
  std::string case_name;
  Parameters parameters;
  std::string method;
  Finding finding;
  Verdict expected = Verdict::kStable;
  std::string source;
  double seconds = 0;  ///< wall time of the trial
  std::string reason;  ///< reason of a failure
  bool worse() const { return finding.verdict > expected; }
};

/// JSON with the keys case, parameters, method, verdict, metric, value, unit, bound, oracle, source, seconds, expected
/// (and reason). A value that is not finite is null.
nlohmann::json toJson(const Row& row);

/// Serialise findings for the pipe from a trial's process.
std::string packFindings(const std::vector<Finding>& findings);
std::vector<Finding> unpackFindings(const std::string& text);

}  // namespace presa::stability
