#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/section.h"
#include "framework/record/record_plugin.h"

namespace presa::experiment::analysis {
namespace {

using terminal::format;

/// Signals of one trial, as in figure 12 of the PERCRO paper.
struct Course {
  std::vector<double> time, finger, body, force, state;  ///< heights [m], normal force [N], ContactMode
};

const RecordedTable* find(const std::vector<RecordedTable>& tables, const std::string& name) {
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const auto& table) { return table.name == name; });
  return found == tables.end() ? nullptr : &*found;
}

const Trials::Row* chosen(const wanted::TimeCourse& what, const Trials& trials) {
  const auto found = std::find_if(trials.rows.begin(), trials.rows.end(), [&](const Trials::Row& row) {
    return (what.subject.empty() || trials.subjects[row.subject] == what.subject) &&
           (what.trial == 0 || row.number == what.trial);
  });
  return found == trials.rows.end() ? nullptr : &*found;
}

struct Phase {
  std::string name;
  double begin = 0, end = 0;
};

std::vector<Phase> phasesOf(const Trials::Row& row) {
  std::vector<Phase> phases;
  for (const auto& [name, stretch] : row.phases.items()) {
    if (stretch.is_array() && stretch.size() == 2 && stretch[0].is_number() && stretch[1].is_number())
      phases.push_back({name, stretch[0], stretch[1]});
  }
  return phases;
}

/// Per phase: share of time in each contact state, mean normal force, and the drift of the finger on the body while it
/// stuck.
Table checksOf(const Course& course, const std::vector<Phase>& phases) {
  Table table{"time_course",
              {{"phase"},
               {"begin", "s", "%.3f"},
               {"end", "s", "%.3f"},
               {"no_contact", "%", "%.1f"},
               {"sticking", "%", "%.1f"},
               {"slipping", "%", "%.1f"},
               {"wandering_while_sticking", "mm", "%.3f"},
               {"mean_force", "N", "%.3f"}},
              {}};
  for (const Phase& phase : phases) {
    std::array<double, 3> in_state{};
    double ticks = 0, force = 0, low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < course.time.size(); ++i) {
      if (course.time[i] < phase.begin || course.time[i] >= phase.end) continue;
      ++ticks;
      force += course.force[i];
      ++in_state[static_cast<std::size_t>(course.state[i])];
      if (course.state[i] != 1) continue;
      low = std::min(low, course.finger[i] - course.body[i]), high = std::max(high, course.finger[i] - course.body[i]);
    }
    if (ticks == 0) continue;
    std::vector<Cell> row{phase.name, phase.begin, phase.end};
    for (const double count : in_state) row.emplace_back(100 * count / ticks);
    row.push_back(cellOf(high >= low ? std::optional(1000 * (high - low)) : std::nullopt));
    row.emplace_back(force / ticks);
    table.rows.push_back(std::move(row));
  }
  return table;
}

svg::TimeFigure figureOf(const wanted::TimeCourse& what, const Course& course, const std::vector<Phase>& phases) {
  svg::TimeFigure figure;
  figure.title = "Height, contact state and grip force of one trial over time";
  figure.time = course.time;
  for (const Phase& phase : phases) figure.bands.push_back({phase.name, phase.begin, phase.end});
  svg::Panel height{.title = "Height", .unit = "m", .height = 200};
  height.series = {{what.finger, "finger", course.finger}, {what.body, "object", course.body}};
  svg::Panel state{.title = "Contact state", .height = 72, .names = {"none", "stick", "slip"}};
  state.series = {{what.finger, "state", course.state, true}};
  svg::Panel force{.title = "Grip force", .unit = "N", .height = 140, .from_zero = true};
  force.series = {{"normal force of " + what.finger, "force", course.force}};
  figure.panels = {std::move(height), std::move(state), std::move(force)};
  return figure;
}

}  // namespace

Section section(const wanted::TimeCourse& what, const Context& context) {
  Section section{"time_course", "One trial",
                  "every haptic tick of the recording; wandering: range of the finger's height above the " + what.body};
  const Trials& trials = context.trials;
  const Trials::Row* row = chosen(what, trials);
  if (row == nullptr) {
    section.notes.emplace_back("There is no such trial that counts.");
    return section;
  }
  const std::string whose = format("trial %d of %s", row->number, trials.subjects[row->subject].c_str());
  section.title += ": " + whose;
  if (row->file.empty() || !std::filesystem::exists(row->file)) {
    section.notes.push_back("The recording of " + whose + " is not there" +
                            (row->file.empty() ? "." : ": " + row->file));
    return section;
  }
  Course course;
  try {
    const RecordedSamples samples = recordPlugin().samples(row->file);
    const RecordedTable* finger = find(samples.fingers, what.finger);
    const RecordedTable* body = find(samples.bodies, what.body);
    if (finger == nullptr || body == nullptr) {
      section.notes.push_back("The recording of " + whose + " has no " + (finger == nullptr ? what.finger : what.body) +
                              ".");
      return section;
    }
    course = {samples.time, finger->values("p_WH_z"), body->values("p_WB_z"), finger->values("normal_force"),
              finger->values("mode")};
  } catch (const InputError& error) {
    section.notes.push_back("The recording of " + whose +
                            " cannot be read: " + error.diagnostics().all().front().message);
    return section;
  }
  const std::vector<Phase> phases = phasesOf(*row);
  std::string condition;
  for (const Variable& variable : variablesOf(context.experiment)) {
    if (variable.kind != Variable::Kind::kColumn) continue;
    const std::string& level = trials.labels.at(variable.name)[static_cast<std::size_t>(row - trials.rows.data())];
    condition += (condition.empty() ? "" : ", ") + variable.name + " " + level +
                 (variable.unit.empty() || variable.unit == "1" ? "" : " " + variable.unit);
  }
  section.figure = svg::render(figureOf(what, course, phases));
  section.figure_caption = condition.empty() ? "" : "Condition: " + condition + ".";
  section.tables.push_back(checksOf(course, phases));
  return section;
}

}  // namespace presa::experiment::analysis
