#include <algorithm>

#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/cells.h"
#include "apps/experiment/analysis/section.h"

namespace presa::experiment::analysis {

CellMeansOf cellMeans(const Context& context, const std::string& y, const NameList& by) {
  const Trials& trials = context.trials;
  CellMeansOf result;
  std::vector<statistics::LabelledValue> labelled;
  for (const Group& group : groupsBy(context.experiment, trials, by, trials.complete({y}))) {
    const std::vector<double> values = trials.numbersOf(y, group.rows);
    const auto over_trials = statistics::meanInterval(values, context.confidence());
    result.cells.push_back({group, *statistics::mean(values), statistics::standardDeviation(values),
                            over_trials ? std::optional(over_trials->interval) : std::nullopt, std::nullopt});
    for (std::size_t i = 0; i < values.size(); ++i)
      labelled.push_back(
          {static_cast<int>(trials.rows[group.rows[i]].subject), static_cast<int>(result.cells.size()) - 1, values[i]});
  }
  const auto within = statistics::withinSubjectIntervals(labelled, context.confidence());
  if (!within) return result;
  result.correction = within->correction;
  for (const auto& condition : within->conditions)
    result.cells[static_cast<std::size_t>(condition.condition)].within_subject = condition.interval;
  return result;
}

Section section(const wanted::CellMeans& what, const Context& context) {
  const CellMeansOf means = cellMeans(context, what.y, what.by);
  Section section{"cell_means", "Means of " + what.y,
                  "interval: " + context.percent() + " t interval of the trials of a cell"};
  const std::string unit = context.unitOf(what.y);
  std::string id = "cell_means_" + what.y;
  Table table;
  for (const std::string& name : what.by) {
    table.columns.push_back({name, context.unitOf(name)});
    id += "_" + name;
  }
  table.id = id;
  table.columns.insert(table.columns.end(),
                       {{"n", "", "%.0f"}, {"mean", unit}, {"sd", unit, "%.2g"}, {"interval", unit}});
  if (means.correction) {
    table.columns.push_back({"within_subject", unit});
    section.method += terminal::format(
        "; within_subject: of the subjects' means, what subjects have in common with themselves taken out (Cousineau "
        "2005), times %.4f (Morey 2008); for differences between cells",
        *means.correction);
  } else {
    section.notes.emplace_back("No within-subject interval: it takes two subjects or more, each with every cell.");
  }
  for (const CellMeansOf::OfCell& cell : means.cells) {
    std::vector<Cell> row(cell.group.levels.begin(), cell.group.levels.end());
    row.insert(row.end(), {static_cast<double>(cell.group.rows.size()), cell.mean});
    row.push_back(cellOf(cell.sd));
    row.push_back(cellOf(cell.over_trials));
    if (means.correction) row.push_back(cellOf(cell.within_subject));
    table.rows.push_back(std::move(row));
  }
  table.folded = table.rows.size() > 30;
  noteIncomplete(context, {what.y}, section);
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace presa::experiment::analysis
