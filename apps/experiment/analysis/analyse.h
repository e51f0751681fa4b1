#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/experiment/analysis/section.h"

namespace presa::experiment::analysis {

struct Request {
  std::string data;        ///< folder of a dataset, or of one session
  std::string experiment;  ///< file whose analysis is wanted; empty: the dataset's own copy
};

/// What a dataset came to. Deterministic: the same data and analysis give the same text.
struct Result {
  std::string data;
  std::string analysis_file;  ///< where the analysis stands
  Experiment experiment;
  Trials trials;
  std::vector<std::string> notes{};  ///< about the data as a whole
  std::vector<Section> sections{};
  bool interrupted = false;

  /// What is found, in sentences.
  std::vector<std::string> headlines() const;
};

/// Told after each part: how many are done, of how many, and which it was; first with 0. False ends the analysis.
using Progress = std::function<bool(std::size_t done, std::size_t all, const std::string& what)>;
/// Throws InputError: E92x, E94x, and all findings of the experiment file.
Result analyse(const Request& request, const Progress& progress);

std::string reportHtml(const Result& result);
std::string reportJson(const Result& result);

/// report.html, analysis.json and tables/ID.csv in `out`. What an earlier analysis left in tables/ goes. Throws
/// std::system_error.
void write(const Result& result, const std::string& out);

}  // namespace presa::experiment::analysis
