#include "apps/studies/printed/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/common/number_text.h"
#include "apps/common/summary.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal/text.h"
#include "apps/common/terminal_run.h"
#include "framework/core/diagnostics/refuse.h"

namespace presa::printed {
namespace {

using nlohmann::json;
using Sets = std::vector<std::string>;
using terminal::format;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kTraceRate = 250;  // as `presa run`

/// Runs of one comparison, one after the other, with their progress.
class Runs {
 public:
  explicit Runs(const std::string& scene) : scene_(scene), progress_(0) {}

  void expect(std::size_t runs) { progress_.more(runs); }
  void leaveOut(std::size_t runs) { progress_.fewer(runs); }
  json summary(const Sets& sets) {
    Diagnostics diagnostics;
    RunOptions options;
    options.duration = 0;  // to the end of the script
    options.bound_stiffness = true;
    Loaded loaded = loadWorld({scene_, "", sets}, options, diagnostics);
    if (diagnostics.hasErrors()) throw InputError(diagnostics);
    TerminalRun run(std::move(loaded), {.trace_rate = kTraceRate, .quiet = true, .command = ""});
    run.execute();
    if (run.result().interrupted || terminal::JobProgress::interrupted()) throw Stopped();
    progress_.done(sets.empty() ? "as printed" : sets.front());
    return json::parse(summaryJson(run.result()));
  }

 private:
  const std::string& scene_;
  terminal::JobProgress progress_;
};

double at(const json& value, const char* pointer) {
  const json::json_pointer where(pointer);
  return value.contains(where) && value.at(where).is_number() ? value.at(where).get<double>() : kNone;
}

Sets operator+(Sets a, const Sets& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string setOf(const PrintedValues& what, double value) { return what.path + "=" + significant(value, 9); }

/// Every combination of the values, the last one changing fastest.
std::vector<std::vector<double>> gridOf(const std::vector<PrintedValues>& vary) {
  std::vector<std::vector<double>> grid{{}};
  for (const PrintedValues& axis : vary) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& begin : grid) {
      for (const double value : axis.values) {
        longer.push_back(begin);
        longer.back().push_back(value);
      }
    }
    grid = std::move(longer);
  }
  return grid;
}

/// The last value at which the object is held, with these overrides; `min_mass`: of that run, if there is one.
std::optional<double> lastHeld(Runs& runs, const UntilLost& lost, const Sets& methods, double* min_mass = nullptr) {
  std::optional<double> held;
  std::size_t left = lost.values.size();
  for (const double value : lost.values) {
    const Grasp grasp = graspOf(runs.summary(lost.sets + methods + Sets{setOf(lost, value)}));
    --left;
    if (!grasp.held) break;
    held = value;
    if (min_mass != nullptr) *min_mass = grasp.min_mass;
  }
  runs.leaveOut(left);
  return held;
}

void runCells(Runs& runs, Comparison& comparison) {
  const Printed& print = comparison.print;
  if (print.vary.empty()) return;
  for (const std::vector<double>& values : gridOf(print.vary)) {
    Sets sets;
    for (std::size_t i = 0; i < values.size(); ++i) sets.push_back(setOf(print.vary[i], values[i]));
    comparison.cells.push_back({values, graspOf(runs.summary(sets)), graspOf(runs.summary(sets + print.today))});
  }
}

void runUntilLost(Runs& runs, Comparison& comparison) {
  if (!comparison.print.until_lost) return;
  const UntilLost& lost = *comparison.print.until_lost;
  Lasting& lasting = comparison.lasting.emplace();
  lasting.min_mass = kNone;
  lasting.printed = lastHeld(runs, lost, {});
  lasting.today = lastHeld(runs, lost, comparison.print.today, &lasting.min_mass);
}

void runAlone(Runs& runs, Comparison& comparison) {
  for (const std::string& set : comparison.print.today) {
    Alone alone{set, graspOf(runs.summary({set})), {}};
    if (comparison.print.until_lost) alone.lasting = lastHeld(runs, *comparison.print.until_lost, {set});
    comparison.alone.push_back(std::move(alone));
  }
}

/// Number of runs, if nothing is lost until the last value.
std::size_t runCount(const Printed& print) {
  const std::size_t until_lost = print.until_lost ? print.until_lost->values.size() : 0;
  const std::size_t cells = print.vary.empty() ? 0 : gridOf(print.vary).size();
  return 2 + 2 * cells + 2 * until_lost + print.today.size() * (1 + until_lost);
}

/// "0.044 to 0.244", of the cells.
std::string rangeOf(const std::vector<Cell>& cells, Grasp Cell::*which, double Grasp::*figure, double factor,
                    int digits) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Cell& cell : cells) {
    const double value = cell.*which.*figure * factor;
    if (std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return "–";
  const std::string first = fixed(low, digits), last = fixed(high, digits);
  return first == last ? first : first + " to " + last;
}

std::string lastingText(const std::optional<double>& value, const std::string& unit) {
  return value ? significant(*value, 4) + " " + unit : "no value";
}

}  // namespace

Grasp graspOf(const json& summary) {
  Grasp grasp;
  grasp.frequency = at(summary, "/grasp/natural_frequency_hz");
  grasp.min_mass = at(summary, "/grasp/explicit_min_mass_kg");
  grasp.slip_limit = at(summary, "/grasp/slip_limit_N");
  grasp.ripple = grasp.mismatch = grasp.slip = grasp.slip_known_to = grasp.offset = kNone;
  if (!summary.contains("grasp")) return grasp;
  const double hold = at(summary, "/grasp/hold_s/1") - at(summary, "/grasp/hold_s/0");
  grasp.held = at(summary, "/grasp/held_in_stick_s") > hold - 0.002;  // two ticks: the ends of the phase
  double farthest = -1;
  for (const json& finger : summary.at("grasp").at("fingers")) {
    grasp.ripple = std::fmax(grasp.ripple, at(finger, "/grip_ripple"));
    grasp.offset = std::fmax(grasp.offset, at(finger, "/offset_range_mm"));
    const double slip = at(finger, "/slip_onset/normal_force_N");
    if (!(std::abs(slip - grasp.slip_limit) > farthest)) continue;
    farthest = std::abs(slip - grasp.slip_limit);
    grasp.slip = slip;
    grasp.slip_known_to = at(finger, "/slip_known_to_N");
  }
  for (const json& point : summary.at("contact_points"))
    grasp.mismatch = std::fmax(grasp.mismatch, at(point, "/impulse_mismatch/worst"));
  return grasp;
}

bool Comparison::holds() const {
  return std::ranges::all_of(cells, [](const Cell& cell) { return cell.today.held; });
}

std::vector<std::string> Comparison::sentences() const {
  const auto held = [this](Grasp Cell::*which) {
    return std::ranges::count_if(cells, [which](const Cell& cell) { return (cell.*which).held; });
  };
  const auto both = [this](double Grasp::*figure, double factor, int digits, const char* unit) {
    return rangeOf(cells, &Cell::printed, figure, factor, digits) + unit + " as printed, " +
           rangeOf(cells, &Cell::today, figure, factor, digits) + unit + " with the methods of today.";
  };
  std::vector<std::string> all;
  if (!cells.empty()) {
    all.push_back(
        format("%td of %zu grasps are held in stick for all of the hold as printed, %td with the methods of "
               "today; their natural frequencies are %s Hz.",
               held(&Cell::printed), cells.size(), held(&Cell::today),
               rangeOf(cells, &Cell::today, &Grasp::frequency, 1, 1).c_str()));
    all.push_back("In the hold the object creeps in the grip by " + both(&Grasp::offset, 1, 3, " mm"));
    all.push_back("The largest difference over 0.1 s between what the user feels and what the object gets is " +
                  both(&Grasp::mismatch, 100, 1, " %"));
  }
  if (lasting) {
    const UntilLost& lost = *print.until_lost;
    std::string at;
    for (const std::string& set : lost.sets) at += (at.empty() ? "With " : " and ") + set;
    std::string sentence = (at.empty() ? "The" : at + " the") + (" object is held down to a " + lost.name) + " of " +
                           lastingText(lasting->printed, lost.unit) + " as printed, of " +
                           lastingText(lasting->today, lost.unit) + " with the methods of today";
    if (!std::isnan(lasting->min_mass)) sentence += "; n K h² / 4 is " + significant(lasting->min_mass, 4) + " kg";
    all.push_back(sentence + ".");
  }
  return all;
}

Comparison compare(const std::string& scene) {
  Diagnostics diagnostics;
  auto print = printedOf(scene, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  if (!print)
    refuse(619, scene, "no file says what is printed about this scene",
           "such a file lies in the folder 'printed' beside the scene and has its name; config/scenes/percro_2006.xml "
           "has one");
  Comparison comparison{scene, std::move(*print), {}, {}, {}, {}, {}};
  Runs runs(scene);
  runs.expect(runCount(comparison.print));
  comparison.printed = runs.summary({});
  comparison.today = runs.summary(comparison.print.today);
  runCells(runs, comparison);
  runUntilLost(runs, comparison);
  runAlone(runs, comparison);
  return comparison;
}

}  // namespace presa::printed
