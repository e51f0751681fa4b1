#include "apps/experiment/trial_table.h"

#include <functional>

#include "experiments/runner/definition/row.h"

namespace presa::experiment {
namespace {

struct TableColumn {
  std::string name, unit, description;
  std::function<std::string(const SessionStart&, const LoggedRun&)> value;
};

constexpr const char* kNothing = "n/a";

std::string textOf(const Json& value) {
  if (value.is_null()) return kNothing;
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (!value.is_string()) return value.dump();
  const auto text = value.get<std::string>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

/// Text of record[a][b], or kNothing when it is missing.
std::string at(const Json& record, const std::string& a, const std::string& b = {}) {
  if (!record.is_object() || !record.contains(a)) return kNothing;
  const Json& value = record[a];
  if (b.empty()) return textOf(value);
  return value.is_object() && value.contains(b) ? textOf(value[b]) : kNothing;
}

std::vector<TableColumn> columnsOf(const Experiment& experiment) {
  using S = const SessionStart&;
  using R = const LoggedRun&;
  const auto from_begin = [](const std::string& name) { return [name](S, R run) { return at(run.begin, name); }; };
  const auto from_end = [](const std::string& name) { return [name](S, R run) { return at(run.end, name); }; };
  // prefer the condition's own text: a level may be a word, and 0.4 keeps its spelling
  const auto value = [](const std::string& name) {
    return [name](S, R run) {
      const std::string given = at(run.begin, "condition", name);
      return given != kNothing ? given : at(run.end, "values", name);
    };
  };
  std::vector<TableColumn> columns{
      {"subject", "", "pseudonym", [](S start, R) { return start.subject.id; }},
      {"session", "", "", [](S start, R) { return std::to_string(start.session); }},
      {"model", "",
       "what held the devices if no person did" + (experiment.model.empty() ? "" : ": " + experiment.model),
       [](S start, R) { return start.model.empty() ? kNothing : textOf(start.model); }},
      {"trial", "", "number in the planned order; practice trials count by themselves", from_begin("trial")},
      {"practice", "", "1: does not count", from_begin("practice")},
      {"block", "", "", from_begin("block")},
      {"repeat", "", "how often the subject meets the condition with this trial", from_begin("repeat")},
      {"attempt", "", "1, and one more after every abort", from_begin("attempt")},
      {"run", "", "how often the trial was begun, interruptions included", from_begin("run")},
      {"outcome", "", "done, aborted, interrupted or skipped",
       [](S, R run) { return std::string(toString(run.outcome)); }},
      {"reason", "", "of an abort or interruption", from_end("reason")},
      {"excluded", "", "rule of the experiment by which the trial does not count", from_end("excluded")}};
  for (const RowColumn& column : rowColumns(experiment))
    columns.push_back({column.name, column.unit, column.description, value(column.name)});
  columns.push_back({"simulated", "s", "length of the trial", from_end("simulated_s")});
  columns.push_back({"wall", "s", "time that it took", from_end("wall_s")});
  columns.push_back({"file", "", "every haptic tick; a second interval is beside it",
                     [](S, R run) { return run.files().empty() ? std::string(kNothing) : run.files().front(); }});
  return columns;
}

}  // namespace

std::string trialTable(const Experiment& experiment, const SessionLog& log) {
  const std::vector<TableColumn> columns = columnsOf(experiment);
  std::string text;
  for (const TableColumn& column : columns) text += (text.empty() ? "" : ",") + headingOf(column.name, column.unit);
  text += "\n";
  for (const LoggedRun& run : log.runs) {
    std::string row;
    for (const TableColumn& column : columns) {
      const std::string cell = column.value(log.start, run);
      row += (&column == &columns.front() ? "" : ",") + (cell.empty() ? std::string(kNothing) : cell);
    }
    text += row + "\n";
  }
  return text;
}

std::string tableColumnsJson(const Experiment& experiment) {
  Json all = Json::object();
  for (const TableColumn& column : columnsOf(experiment)) {
    Json& one = all[headingOf(column.name, column.unit)];
    one = {{"Description", column.description}};
    if (!column.unit.empty()) one["Units"] = column.unit;
  }
  return all.dump(2) + "\n";
}

}  // namespace presa::experiment
