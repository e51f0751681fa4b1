#include <algorithm>
#include <map>

#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/psychometric_fit.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::experiment::analysis {
namespace {

using statistics::Interval;
using statistics::PsychometricFunction;
using terminal::format;

/// The standard: `text` is a number, or a column with one value in all these trials.
std::optional<double> standardOf(const std::string& text, const Trials& trials, const std::vector<std::size_t>& rows) {
  if (text.empty()) return std::nullopt;
  double value = 0;
  if (xml::readNumber(text, value) == xml::NumberKind::kFinite) return value;
  const std::vector<double> values = trials.numbersOf(text, rows);
  const bool same = std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); });
  return same && !values.empty() ? std::optional(values.front()) : std::nullopt;
}

std::string thresholdName(const wanted::Psychometric& what) {
  if (!what.model.guess && what.threshold == 0.5) return "PSE";
  return "threshold_" + format("%g", 100 * what.threshold) + "_percent";
}

/// The reported numbers of one fit, by column.
using Numbers = std::map<std::string, Cell>;

Numbers numbersOf(const wanted::Psychometric& what, const Context& context, const Stimulus& stimulus, const Fit& fit) {
  Numbers numbers{{"n", static_cast<double>(fit.group.rows.size())},
                  {"levels", static_cast<double>(fit.levels.size())},
                  {"verdict", std::string(statistics::words(fit.result.verdict))}};
  if (!fit.result.fit) return numbers;
  const std::string threshold = thresholdName(what);
  const PsychometricFunction& function = fit.result.fit->function;
  const auto at = function.threshold(what.threshold);
  numbers[threshold] = cellOf(at);
  numbers["jnd"] = function.jnd();
  numbers["lapse"] = function.lapse;
  numbers["deviance"] = fit.result.fit->deviance;
  numbers["p_deviance"] = cellOf(fit.result.fit->deviance_p);
  numbers["weber"] = cellOf(stimulus.weber(what, function, standardOf(what.standard, context.trials, fit.group.rows)));
  if (stimulus.column() && at) numbers[stimulus.column()->name] = stimulus.valueAt(*at);
  if (!fit.bootstrap) return numbers;
  const Interval& around = fit.bootstrap->thresholds.back();
  numbers[threshold + "_interval"] = around;
  numbers["jnd_interval"] = fit.bootstrap->jnd;
  numbers["p_deviance"] = fit.bootstrap->deviance_p;
  if (stimulus.column())
    numbers[stimulus.column()->name + "_interval"] =
        Interval{stimulus.valueAt(around.low), stimulus.valueAt(around.high)};
  return numbers;
}

std::vector<Table::Column> columnsOf(const wanted::Psychometric& what, const Context& context,
                                     const Stimulus& stimulus) {
  std::vector<Table::Column> columns{{"subject"}};
  for (const std::string& name : what.by) columns.push_back({name, context.unitOf(name)});
  const std::string unit = context.unitOf(what.x), threshold = thresholdName(what);
  columns.insert(
      columns.end(),
      {{"n", "", "%.0f"}, {"levels", "", "%.0f"}, {threshold, unit, "%.4g"}, {threshold + "_interval", unit, "%.4g"}});
  if (stimulus.column()) {
    const auto& [name, stimulus_unit, paths] = *stimulus.column();
    columns.push_back({name, stimulus_unit, "%.4g"});
    columns.push_back({name + "_interval", stimulus_unit, "%.4g"});
  }
  columns.insert(columns.end(), {{"jnd", unit},
                                 {"jnd_interval", unit},
                                 {"weber", "", "%.3f"},
                                 {"lapse", "", "%.3f"},
                                 {"deviance", "", "%.2f"},
                                 {"p_deviance", "", "p"},
                                 {"verdict"}});
  return columns;
}

std::string withInterval(const Numbers& numbers, const std::string& name, const std::string& unit) {
  const auto value = numbers.find(name), interval = numbers.find(name + "_interval");
  std::string text = value == numbers.end() ? "none" : numberText(std::get<double>(value->second), "%.3g");
  if (!unit.empty() && unit != "1") text += " " + unit;
  if (interval == numbers.end()) return text;
  return text + " (" + intervalText(std::get<Interval>(interval->second), "%.3g") + ")";
}

std::string sentence(const wanted::Psychometric& what, const Context& context, const Stimulus& stimulus, const Fit& fit,
                     const Numbers& numbers) {
  std::string where;
  for (std::size_t i = 0; i < what.by.size(); ++i)
    where += (i > 0 ? ", " : " at ") + what.by[i] + " " + fit.group.levels[i];
  const std::string unit = context.unitOf(what.x), threshold = thresholdName(what);
  std::string text =
      threshold == "PSE" ? "Point of subjective equality" : format("Threshold at %g %%", 100 * what.threshold);
  text += " of " + what.y + where + ": ";
  text += stimulus.column()
              ? stimulus.column()->name + " " + withInterval(numbers, stimulus.column()->name, stimulus.column()->unit)
              : withInterval(numbers, threshold, unit);
  text += "; just noticeable difference " + withInterval(numbers, "jnd", unit);
  const auto* weber = std::get_if<double>(&numbers.at("weber"));
  return text + (weber ? format(", Weber fraction %.1f %%.", 100 * *weber) : std::string("."));
}

std::string methodOf(const wanted::Psychometric& what, const Context& context) {
  const char* const shapes[] = {"cumulative normal", "logistic function", "Weibull function"};
  std::string text = std::string("maximum likelihood fit of a ") + shapes[static_cast<std::size_t>(what.model.shape)];
  text += what.model.guess ? format(", guess %g", *what.model.guess) : std::string(", guess equal to the lapse");
  text += what.model.lapse ? format(", lapse %g", *what.model.lapse)
                           : format(", lapse fitted in 0 to %g", what.model.lapse_max);
  text += "; jnd: half the distance between a quarter and three quarters of the rise";
  if (what.draws > 0)
    text += format("; percentile intervals of %zu parametric bootstraps, ", what.draws) + context.percent();
  return text;
}

}  // namespace

Section section(const wanted::Psychometric& what, const Context& context) {
  const Stimulus stimulus(what, context.experiment);
  Section section{"psychometric", titleOf(what, context), methodOf(what, context)};
  Table table{"psychometric_" + what.x + "_" + what.y, columnsOf(what, context, stimulus), {}};
  const bool several = context.trials.subjects.size() > 1;
  const std::vector<Fit> fits = fitsOf(what, context, stimulus);
  for (const Fit& fit : fits) {
    Numbers numbers = numbersOf(what, context, stimulus, fit);
    if (fit.result.fit && (fit.subject == "all") == several)
      section.finding.push_back(sentence(what, context, stimulus, fit, numbers));
    std::vector<Cell> row{fit.subject};
    row.insert(row.end(), fit.group.levels.begin(), fit.group.levels.end());
    for (std::size_t c = row.size(); c < table.columns.size(); ++c) row.push_back(numbers[table.columns[c].name]);
    table.rows.push_back(std::move(row));
  }
  section.figure = figureOf(what, context, fits);
  if (several)
    section.notes.emplace_back(
        "all: the answers of all subjects in one fit. Where subjects differ it is flatter than the function of any of "
        "them.");
  if (stimulus.folded())
    section.notes.push_back("Levels below the standard count as far above it as they lie below: " + what.y +
                            " knows no side.");
  noteIncomplete(context, {what.x, what.y}, section);
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace presa::experiment::analysis
