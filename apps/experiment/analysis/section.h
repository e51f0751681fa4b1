#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/experiment/analysis/trials.h"
#include "experiments/runner/statistics/interval.h"

namespace presa::experiment::analysis {

/// Nothing, words, a number, or an interval.
using Cell = std::variant<std::monostate, std::string, double, statistics::Interval>;

/// Nothing stays nothing.
template <class Value>
Cell cellOf(const std::optional<Value>& value) {
  Cell cell;
  if (value) cell = *value;
  return cell;
}

/// A result as people, programs and spreadsheets read it: one source for report, JSON and CSV.
struct Table {
  struct Column {
    std::string name, unit{};
    std::string format = "%.3g";  ///< of the report only; "p": a probability
  };
  std::string id;  ///< of its CSV: letters, digits, underscores
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  bool folded = false;  ///< long: the report shows it on demand
};

/// What one element of the analysis came to.
struct Section {
  std::string kind, title;
  std::string method;                  ///< how its numbers were found, with sources
  std::vector<std::string> finding{};  ///< in sentences
  bool headline = true;                ///< they stand at the top of the report too
  std::vector<std::string> notes{};    ///< what a reader must know before he believes it
  std::vector<Table> tables{};
  std::string figure{};          ///< HTML
  std::string figure_caption{};  ///< plain text
};

/// What every analysis works with.
struct Context {
  const Experiment& experiment;
  const Trials& trials;
  double confidence() const { return experiment.analysis.confidence; }
  std::uint64_t seed() const { return experiment.analysis.seed; }
  /// "mass [kg]"
  std::string heading(const std::string& name) const;
  std::string unitOf(const std::string& name) const;
  /// "95 %"
  std::string percent() const;
};

/// One function per element. Deterministic: the same data and seed, the same numbers.
Section section(const wanted::Spearman& what, const Context& context);
Section section(const wanted::CellMeans& what, const Context& context);
Section section(const wanted::Margin& what, const Context& context);
Section section(const wanted::LogLinear& what, const Context& context);
Section section(const wanted::DepthControl& what, const Context& context);
Section section(const wanted::Psychometric& what, const Context& context);
Section section(const wanted::Bars& what, const Context& context);
Section section(const wanted::MeansPlot& what, const Context& context);
Section section(const wanted::MarginPlot& what, const Context& context);
Section section(const wanted::Scatter& what, const Context& context);
Section section(const wanted::TimeCourse& what, const Context& context);

std::string csvOf(const Table& table);
Json jsonOf(const Section& section);
std::string htmlOf(const Table& table);
/// A number as `format` says; "p": as a probability.
std::string numberText(double value, const std::string& format);
/// "0.61 to 0.78"
std::string intervalText(const statistics::Interval& interval, const std::string& format);

/// "3 trials without F_slip_measured are left out", or nothing.
void noteIncomplete(const Context& context, const std::vector<std::string>& names, Section& section);

}  // namespace presa::experiment::analysis
