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
#include "apps/experiment/simulate/study_numbers.h"

namespace presa::experiment {
namespace {

using analysis::Cell;
using analysis::Table;
using terminal::format;

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
std::vector<PowerCurve> curvesOf(const std::map<int, StudyNumbers>& by_size) {
  std::vector<PowerCurve> curves;
  if (by_size.empty()) return curves;
  for (const Spread& test : by_size.rbegin()->second.spreads()) {
    if (test.power < 0) continue;
    PowerCurve& curve = curves.emplace_back();
    curve.test =
        test.table + (test.row.empty() ? "" : ", " + test.row) + (test.column == "p" ? "" : ", " + test.column);
    for (const auto& [subjects, collection] : by_size) {
      for (const Spread& one : collection.spreads()) {
        if (!one.isSame(test) || one.power < 0) continue;
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
  std::map<int, StudyNumbers> by_size;
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
  const StudyNumbers& collection = by_size.at(plan.subjects);
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
