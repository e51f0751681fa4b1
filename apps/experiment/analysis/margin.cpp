#include <algorithm>

#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/section.h"
#include "experiments/runner/statistics/margin.h"
#include "experiments/runner/statistics/means.h"

namespace presa::experiment::analysis {
namespace {

using statistics::MeanEstimate;
using terminal::format;

/// Safety margins of the trials of one group in both conventions: relative to the grip force and to the slip force.
struct Margins {
  std::vector<double> of_grip, of_slip;
};

Margins marginsOf(const Trials& trials, const wanted::Margin& what, const std::vector<std::size_t>& rows) {
  Margins margins;
  for (const std::size_t row : rows) {
    const double grip = trials.numbers.at(what.grip)[row], slip = trials.numbers.at(what.slip)[row];
    const auto of_grip = statistics::relativeSafetyMargin(grip, slip),
               of_slip = statistics::marginOverSlipForce(grip, slip);
    if (of_grip) margins.of_grip.push_back(*of_grip);
    if (of_slip) margins.of_slip.push_back(*of_slip);
  }
  return margins;
}

void addEstimate(const std::vector<double>& values, double confidence, std::vector<Cell>& row) {
  const auto median = statistics::median(values), mean = statistics::mean(values);
  const auto estimate = statistics::meanInterval(values, confidence);
  row.push_back(cellOf(median));
  row.push_back(cellOf(mean));
  row.push_back(cellOf(estimate ? std::optional(estimate->interval) : std::nullopt));
}

/// Sentence on the trend of the medians over the levels of one factor.
std::string sentence(const std::string& by, const std::string& unit, const std::vector<std::string>& levels,
                     const std::vector<double>& medians) {
  if (medians.size() < 2) return {};
  const bool falls = std::is_sorted(medians.rbegin(), medians.rend()),
             rises = std::is_sorted(medians.begin(), medians.end());
  std::string values;
  for (std::size_t i = 0; i < medians.size(); ++i)
    values += (i == 0 ? "" : i + 1 == medians.size() ? " and " : ", ") + numberText(medians[i], "%.1f");
  std::string at;
  for (std::size_t i = 0; i < levels.size(); ++i)
    at += (i == 0 ? "" : i + 1 == levels.size() ? " and " : ", ") + levels[i];
  if (!unit.empty()) at += " " + unit;
  return std::string("The relative safety margin ") +
         (falls   ? "falls with "
          : rises ? "rises with "
                  : "neither only rises nor only falls with ") +
         by + ": " + values + " % of the grip force at " + at + " (medians).";
}

}  // namespace

Section section(const wanted::Margin& what, const Context& context) {
  Section section{
      "margin", "Safety margin of " + what.grip + " over " + what.slip,
      "margin_of_grip: 100 (grip - slip) / grip (Westling and Johansson 1984), margin_of_slip: 100 (grip - slip) / "
      "slip, of each trial; " +
          context.percent() + " t interval of the mean over the trials"};
  Table table;
  std::string id = "margin_" + what.grip;
  for (const std::string& name : what.by) {
    id += "_" + name;
    section.title += (name == what.by.front() ? " by " : " and ") + name;
    table.columns.push_back({name, context.unitOf(name)});
  }
  table.id = id;
  table.columns.push_back({"n", "", "%.0f"});
  for (const char* of : {"grip", "slip"}) {
    const std::string name = std::string("margin_of_") + of;
    table.columns.insert(
        table.columns.end(),
        {{name + "_median", "%", "%.1f"}, {name + "_mean", "%", "%.1f"}, {name + "_interval", "%", "%.1f"}});
  }
  table.columns.push_back({"under_slip", "", "%.0f"});
  std::vector<std::string> levels;
  std::vector<double> medians;
  for (const Group& group :
       groupsBy(context.experiment, context.trials, what.by, context.trials.complete({what.grip, what.slip}))) {
    const Margins margins = marginsOf(context.trials, what, group.rows);
    std::vector<Cell> row(group.levels.begin(), group.levels.end());
    row.push_back(static_cast<double>(margins.of_grip.size()));
    addEstimate(margins.of_grip, context.confidence(), row);
    addEstimate(margins.of_slip, context.confidence(), row);
    row.push_back(static_cast<double>(
        std::count_if(margins.of_grip.begin(), margins.of_grip.end(), [](double m) { return m < 0; })));
    table.rows.push_back(std::move(row));
    if (group.levels.size() == 1 && !margins.of_grip.empty()) {
      levels.push_back(group.levels.front());
      medians.push_back(*statistics::median(margins.of_grip));
    }
  }
  if (what.by.size() == 1) {
    if (const std::string text = sentence(what.by.front(), context.unitOf(what.by.front()), levels, medians);
        !text.empty())
      section.finding.push_back(text);
  }
  table.folded = table.rows.size() > 30;
  noteIncomplete(context, {what.grip, what.slip}, section);
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace presa::experiment::analysis
