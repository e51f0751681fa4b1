#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/experiment/analysis/trials.h"
#include "experiments/runner/statistics/interval.h"

namespace presa::experiment::analysis {

/// A table cell: empty, text, a number or an interval.
using Cell = std::variant<std::monostate, std::string, double, statistics::Interval>;

/// A missing value becomes an empty cell.
template <class Value>
Cell cellOf(const std::optional<Value>& value) {
  Cell cell;
  if (value) cell = *value;
  return cell;
}

/// A result table: the one source for the HTML report, JSON and CSV.
struct Table {
  struct Column {
    std::string name, unit{};
    std::string format = "%.3g";  ///< used in the report only; "p": a probability
  };
  std::string id;  ///< name of its CSV file: letters, digits, underscores
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  bool folded = false;  ///< a long table: the report shows it on demand
};

/// The result of one element of the analysis.
struct Section {
  std::string kind, title;
  std::string method;                  ///< how the numbers were computed, with sources
  std::vector<std::string> finding{};  ///< sentences
  bool headline = true;                ///< the findings are repeated at the top of the report
  std::vector<std::string> notes{};    ///< caveats for the reader
  std::vector<Table> tables{};
  std::string figure{};          ///< HTML
  std::string figure_caption{};  ///< plain text
};

/// The input of every analysis.
struct Context {
  const Experiment& experiment;
  const Trials& trials;
  double confidence() const { return experiment.analysis.confidence; }
  std::uint64_t seed() const { return experiment.analysis.seed; }
  /// Name and unit, such as "mass [kg]".
  std::string heading(const std::string& name) const;
  std::string unitOf(const std::string& name) const;
  /// The confidence level, such as "95 %".
  std::string percent() const;
};

/// One function per element. Deterministic: the same data and seed give the same numbers.
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
/// The number in printf format `format`; "p": as a probability.
std::string numberText(double value, const std::string& format);
/// The bounds, such as "0.61 to 0.78".
std::string intervalText(const statistics::Interval& interval, const std::string& format);

/// Adds a note such as "3 trials without F_slip_measured are left out" to `section`, or nothing if none are left out.
void noteIncomplete(const Context& context, const std::vector<std::string>& names, Section& section);

}  // namespace presa::experiment::analysis
