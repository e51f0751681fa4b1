#include "apps/experiment/simulate/power.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/analyse.h"
#include "apps/experiment/simulate/power_curve.h"

namespace presa::experiment {
namespace {

using analysis::Cell;
using analysis::Table;
using terminal::format;

constexpr double kSignificant = 0.05;

struct Key {
  std::string table, row, column;
  auto operator<=>(const Key&) const = default;
};

/// Numbers of all studies, grouped by their name, in the order of first appearance.
class Collection {
 public:
  void add(int study, const analysis::Result& result) {
    const std::set<std::string> subjects(result.trials.subjects.begin(), result.trials.subjects.end());
    for (const analysis::Section& section : result.sections) {
      for (const Table& table : section.tables) {
        for (const std::vector<Cell>& row : table.rows) addRow(study, table, row, subjects);
      }
    }
  }

  std::vector<Spread> spreads() const {
    std::vector<Spread> all;
    for (const Key& key : order_) all.push_back(spreadOf(key, numbers_.at(key)));
    return all;
  }

  std::string csv() const {
    std::string text = "study,table,row,column,value\n";
    for (const Key& key : order_) {
      for (const auto& [study, value] : numbers_.at(key))
        text += format("%d,\"%s\",\"%s\",\"%s\",%.17g\n", study, key.table.c_str(), key.row.c_str(), key.column.c_str(),
                       value);
    }
    return text;
  }

 private:
  using Values = std::vector<std::pair<int, double>>;  // study, value

  void addRow(int study, const Table& table, const std::vector<Cell>& row, const std::set<std::string>& subjects) {
    std::string name;
    for (const Cell& cell : row) {
      const auto* word = std::get_if<std::string>(&cell);
      if (word == nullptr) continue;
      if (subjects.contains(*word)) return;  // numbers of single subjects are not comparable between studies
      name += (name.empty() ? "" : " ") + *word;
    }
    for (std::size_t c = 0; c < row.size() && c < table.columns.size(); ++c) {
      const auto* value = std::get_if<double>(&row[c]);
      if (value == nullptr) continue;
      const Key key{table.id, name, table.columns[c].name};
      const auto [found, is_new] = numbers_.try_emplace(key);
      if (is_new) order_.push_back(key);
      found->second.emplace_back(study, *value);
      if (table.columns[c].format == "p") probabilities_.insert(key);
    }
  }

  Spread spreadOf(const Key& key, const Values& values) const {
    Spread spread{key.table, key.row, key.column, values.size()};
    std::vector<double> sorted;
    for (const auto& [study, value] : values) sorted.push_back(value);
    std::sort(sorted.begin(), sorted.end());
    const auto n = static_cast<double>(sorted.size());
    for (const double value : sorted) spread.mean += value / n;
    for (const double value : sorted) spread.sd += (value - spread.mean) * (value - spread.mean);
    spread.sd = sorted.size() > 1 ? std::sqrt(spread.sd / (n - 1)) : 0;
    const auto quantile = [&](double share) {  // linear interpolation between order statistics
      const double at = share * (n - 1);
      const auto i = static_cast<std::size_t>(at);
      const double next = i + 1 < sorted.size() ? sorted[i + 1] : sorted[i];
      return sorted[i] + (at - static_cast<double>(i)) * (next - sorted[i]);
    };
    spread.low = quantile(0.025);
    spread.high = quantile(0.975);
    if (probabilities_.contains(key)) {
      const auto below = std::count_if(sorted.begin(), sorted.end(), [](double p) { return p < kSignificant; });
      spread.power = static_cast<double>(below) / n;
    }
    return spread;
  }

  std::map<Key, Values> numbers_;
  std::set<Key> probabilities_;
  std::vector<Key> order_;
};

Table tableOf(const std::vector<Spread>& spreads) {
  Table table{"power",
              {{"table"},
               {"row"},
               {"number"},
               {"studies", "", "%.0f"},
               {"mean", "", "%.4g"},
               {"sd", "", "%.3g"},
               {"2.5 %", "", "%.4g"},
               {"97.5 %", "", "%.4g"},
               {"power", "", "%.2f"}},
              {}};
  for (const Spread& one : spreads) {
    std::vector<Cell> row{one.table, one.row, one.column, static_cast<double>(one.studies),
                          one.mean,  one.sd,  one.low,    one.high};
    row.push_back(one.power < 0 ? Cell() : Cell(one.power));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// One curve per test that the analysis of all subjects has.
std::vector<PowerCurve> curvesOf(const std::map<int, Collection>& by_size) {
  std::vector<PowerCurve> curves;
  if (by_size.empty()) return curves;
  for (const Spread& test : by_size.rbegin()->second.spreads()) {
    if (test.power < 0) continue;
    PowerCurve& curve = curves.emplace_back();
    curve.test =
        test.table + (test.row.empty() ? "" : ", " + test.row) + (test.column == "p" ? "" : ", " + test.column);
    for (const auto& [subjects, collection] : by_size) {
      for (const Spread& one : collection.spreads()) {
        if (one.table != test.table || one.row != test.row || one.column != test.column || one.power < 0) continue;
        const auto significant = static_cast<std::size_t>(std::lround(one.power * static_cast<double>(one.studies)));
        curve.points.push_back(powerPoint(subjects, significant, one.studies));
      }
    }
  }
  return curves;
}

std::string pageOf(const StudiesPlan& plan, const Experiment& experiment, const std::vector<PowerCurve>& curves,
                   const Table& table) {
  const std::string title = experiment.title.empty() ? experiment.name : experiment.title;
  return page::head(title + " – simulated studies – Presa") + "<h1>" + svg::escape(title) +
         "</h1>\n<p class=\"lead\">" +
         format(
             "%d simulated studies of %d subjects each: the distribution of each number of the analysis, and how often "
             "each test is significant (p &lt; 0.05).",
             plan.studies, plan.subjects) +
         "</p>\n" + powerFigure(curves, plan.subjects, plan.power) +
         "<div class=\"verdict neutral\"><b>A model, not a person</b>\n<p>" + svg::escape(experiment.model) +
         ". Power is that of this model; people may differ.</p></div>\n<h2>Every number</h2>\n" + htmlOf(table) +
         page::tail();
}

void print(const std::vector<Spread>& spreads, const std::string& out) {
  for (const Spread& one : spreads) {
    if (one.column == "rho" || one.power >= 0)
      std::printf("  %-28s %-24s %-14s %8.3f [%.3f, %.3f]%s\n", one.table.c_str(), one.row.c_str(), one.column.c_str(),
                  one.mean, one.low, one.high, one.power < 0 ? "" : format("   power %.2f", one.power).c_str());
  }
  std::printf("%s/power.html, power.csv, power_curve.csv; every study: studies.csv\n", out.c_str());
}

}  // namespace

int reportPower(const StudiesPlan& plan, const Experiment& experiment) {
  if (experiment.analysis.items.empty()) {
    std::printf("the experiment names no <analysis>: nothing is computed from the trials\n");
    return kExitOk;
  }
  std::map<int, Collection> by_size;
  terminal::JobProgress progress(static_cast<std::size_t>(plan.studies));
  for (int study = 1; study <= plan.studies; ++study) {
    const auto go_on = [&](std::size_t, std::size_t, const std::string&) {
      progress.show();
      return !terminal::JobProgress::interrupted();
    };
    for (const int subjects : curveSizes(plan.subjects)) {
      const analysis::Result result = analysis::analyse(
          {plan.out + format("/study-%03d", study), plan.experiment_file, static_cast<std::size_t>(subjects)}, go_on);
      if (result.interrupted) return kExitInterrupted;
      by_size[subjects].add(study, result);
    }
    progress.done(format("analysis of study %d", study));
  }
  progress.finish();
  const Collection& collection = by_size.at(plan.subjects);
  const std::vector<Spread> spreads = collection.spreads();
  const std::vector<PowerCurve> curves = curvesOf(by_size);
  const Table table = tableOf(spreads);
  writeFileAtomically(plan.out + "/studies.csv", collection.csv());
  writeFileAtomically(plan.out + "/power.csv", csvOf(table));
  writeFileAtomically(plan.out + "/power_curve.csv", powerCurveCsv(curves));
  writeFileAtomically(plan.out + "/power.html", pageOf(plan, experiment, curves, table));
  print(spreads, plan.out);
  return kExitOk;
}

}  // namespace presa::experiment
