#pragma once
#include <functional>
#include <string>
#include <vector>

#include "apps/experiment/analysis/section.h"

namespace presa::experiment::analysis {

struct Request {
  std::string data;          ///< folder of a dataset, or of one session
  std::string experiment;    ///< experiment file that defines the analysis; empty: the dataset's own copy
  std::size_t subjects = 0;  ///< only the first so many of the dataset; 0: all
  TrialChoice keeps = {};    ///< only these trials; empty: all
};

/// The analysis of one dataset. Deterministic: the same data and analysis give the same text.
struct Result {
  std::string data;
  std::string analysis_file;  ///< experiment file that defines the analysis
  Experiment experiment;
  Trials trials;
  std::vector<std::string> notes{};  ///< about the data as a whole
  std::vector<Section> sections{};
  bool interrupted = false;

  /// The findings of all sections that are headlines, as sentences.
  std::vector<std::string> headlines() const;
};

/// Called before the first section (`done` = 0) and after each one; `what` is the kind of the section just finished.
/// Return false to end the analysis.
using Progress = std::function<bool(std::size_t done, std::size_t all, const std::string& what)>;
/// Throws InputError: E92x, E94x, and all findings of the experiment file.
Result analyse(const Request& request, const Progress& progress);

std::string reportHtml(const Result& result);
std::string reportJson(const Result& result);

/// Writes report.html, analysis.json and tables/ID.csv into `out` and deletes the CSV files of an earlier analysis from
/// tables/. Throws std::system_error.
void write(const Result& result, const std::string& out);

}  // namespace presa::experiment::analysis
