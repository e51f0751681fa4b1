#include "apps/experiment/simulate/variations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>
#include <utility>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/job_progress.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/analyse.h"
#include "apps/experiment/simulate/study_numbers.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/scene/xml/xml.h"

namespace presa::experiment {
namespace {

using analysis::Cell;
using analysis::Table;
using terminal::format;

enum VariationCode { kNoSetting = 954 };

using TrialKey = std::pair<std::string, int>;  // subject, number
using TrialSet = std::set<TrialKey>;

std::string folderOf(const StudiesPlan& plan, int study) { return plan.out + format("/study-%03d", study); }

TrialSet countedIn(const StudiesPlan& plan, int study, const Experiment& experiment) {
  const analysis::Trials trials = analysis::trialsOf(experiment, analysis::readSessions(folderOf(plan, study)));
  TrialSet counted;
  for (const analysis::Trials::Row& row : trials.rows) counted.emplace(trials.subjects[row.subject], row.number);
  return counted;
}

/// Of each study, the trials that count in every variation.
std::vector<TrialSet> commonTrials(const std::vector<Variation>& variations, const Experiment& experiment) {
  std::vector<TrialSet> common;
  for (int study = 1; study <= variations.front().plan.studies; ++study) {
    TrialSet all = countedIn(variations.front().plan, study, experiment);
    for (const Variation& variation : variations) {
      const TrialSet here = countedIn(variation.plan, study, experiment);
      std::erase_if(all, [&](const TrialKey& trial) { return !here.contains(trial); });
    }
    common.push_back(std::move(all));
  }
  return common;
}

/// The studies of one variation.
struct Varied {
  std::vector<Spread> numbers;
  std::size_t aborted = 0;  ///< runs that a rule of the experiment ended, such as drops
};

/// None when interrupted.
std::optional<Varied> numbersOf(const StudiesPlan& plan, const std::vector<TrialSet>& common,
                                terminal::JobProgress& progress) {
  StudyNumbers numbers;
  Varied varied;
  for (int study = 1; study <= plan.studies; ++study) {
    const TrialSet& trials = common[static_cast<std::size_t>(study - 1)];
    const auto go_on = [&](std::size_t, std::size_t, const std::string&) {
      progress.show();
      return !terminal::JobProgress::interrupted();
    };
    const analysis::Result result = analysis::analyse({.data = folderOf(plan, study),
                                                       .experiment = plan.experiment_file,
                                                       .subjects = static_cast<std::size_t>(plan.subjects),
                                                       .keeps =
                                                           [&](const std::string& subject, int trial) {
                                                             return trials.contains({subject, trial});
                                                           }},
                                                      go_on);
    if (result.interrupted) return std::nullopt;
    numbers.add(study, result);
    for (const analysis::SessionCensus& session : result.trials.sessions) varied.aborted += session.aborted;
    progress.done(format("analysis of study %d", study));
  }
  varied.numbers = numbers.spreads();
  return varied;
}

/// The number of the same name; null where a variation lacks it.
const Spread* sameIn(const std::vector<Spread>& spreads, const Spread& one) {
  const auto found = std::ranges::find_if(spreads, [&](const Spread& other) { return other.isSame(one); });
  return found == spreads.end() ? nullptr : &*found;
}

/// Whether it is the correlation of the experiment's first such table, its main result.
bool isShown(const Spread& one, const std::vector<Spread>& given) {
  const auto first = std::ranges::find(given, std::string("rho"), &Spread::column);
  return one.column == "rho" && first != given.end() && one.table == first->table;
}

using Numbers = std::vector<Varied>;  // of each variation

/// "as the rig has it", with the runs that a rule ended.
std::string rowOf(const Variation& variation, const Varied& varied) {
  return variation.name() + format(", %zu runs aborted", varied.aborted);
}

/// One row for each variation: every shown number and its difference from the first variation.
Table differences(const std::vector<Variation>& variations, const Numbers& numbers) {
  Table table{"variations", {{"variation"}}, {}};
  for (const Spread& one : numbers.front().numbers) {
    if (!isShown(one, numbers.front().numbers)) continue;
    table.columns.push_back({one.row, "", "%.3f"});
    table.columns.push_back({"difference", "", "%+.3f"});
  }
  for (std::size_t v = 0; v < variations.size(); ++v) {
    std::vector<Cell> row{rowOf(variations[v], numbers[v])};
    for (const Spread& given : numbers.front().numbers) {
      if (!isShown(given, numbers.front().numbers)) continue;
      const Spread* here = sameIn(numbers[v].numbers, given);
      row.push_back(here != nullptr ? Cell(here->mean) : Cell());
      row.push_back(here != nullptr && v > 0 ? Cell(here->mean - given.mean) : Cell());
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string csvWith(const std::vector<Variation>& variations, const Numbers& numbers) {
  std::string text = "variation,table,row,column,studies,mean,sd\n";
  for (std::size_t v = 0; v < variations.size(); ++v) {
    for (const Spread& one : numbers[v].numbers)
      text += format("\"%s\",\"%s\",\"%s\",\"%s\",%zu,%.17g,%.17g\n", variations[v].name().c_str(), one.table.c_str(),
                     one.row.c_str(), one.column.c_str(), one.studies, one.mean, one.sd);
  }
  return text;
}

std::string pageOf(const StudiesPlan& plan, const Experiment& experiment, const Table& table) {
  const std::string title = experiment.title.empty() ? experiment.name : experiment.title;
  return page::head(title + " – what the devices do to it – Presa") + "<h1>" + svg::escape(title) +
         "</h1>\n<p class=\"lead\">" +
         format(
             "Correlations of %d simulated %s of %d %s each, mean over the studies: as the rig has the devices, and "
             "with one setting changed; same subjects, same order of trials, only trials that count in every row.",
             plan.studies, plan.studies == 1 ? "study" : "studies", plan.subjects,
             plan.subjects == 1 ? "subject" : "subjects") +
         "</p>\n" + htmlOf(table) + "<div class=\"verdict neutral\"><b>A model, not a person</b>\n<p>" +
         svg::escape(experiment.model) + ".</p></div>\n" + page::tail();
}

void print(const std::vector<Variation>& variations, const Numbers& numbers, const std::string& out) {
  for (std::size_t v = 0; v < variations.size(); ++v) {
    std::string line = format("  %-44s", rowOf(variations[v], numbers[v]).c_str());
    for (const Spread& given : numbers.front().numbers) {
      const Spread* here = isShown(given, numbers.front().numbers) ? sameIn(numbers[v].numbers, given) : nullptr;
      if (here == nullptr) continue;
      line += format("  %s %6.3f", given.row.c_str(), here->mean);
      if (v > 0) line += format(" (%+.3f)", here->mean - given.mean);
    }
    std::printf("%s\n", line.c_str());
  }
  std::printf("%s/variations.html, variations.csv\n", out.c_str());
}

}  // namespace

std::vector<Variation> variationsOf(const StudiesPlan& plan, const std::vector<std::string>& settings) {
  std::vector<Variation> all{{.key = {}, .value = {}, .plan = plan}};
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      refuse(kNoSetting, "--vary", "must be KEY=VALUE, found " + quote(setting),
             "a setting of the rig's devices, such as --vary without=encoders");
    all.push_back({setting.substr(0, equals), setting.substr(equals + 1), plan});
  }
  for (std::size_t v = 0; v < all.size(); ++v) {
    all[v].plan.out = plan.out + format("/variation-%zu", v);
    all[v].plan.rig_file = all[v].plan.out + "/rig.xml";
  }
  return all;
}

std::string rigWith(const std::string& rig_xml, const Variation& variation) {
  if (variation.key.empty()) return rig_xml;
  Diagnostics diagnostics;
  const auto document = xml::Document::parse(rig_xml, "rig", diagnostics);
  if (!document) throw InputError(diagnostics);
  const SourceLocation origin{"--vary", 0, 0};
  for (const xml::Element& device : document->root().children("device")) {
    const std::vector<xml::Element> sets = device.children("set");
    const auto found =
        std::ranges::find_if(sets, [&](const xml::Element& set) { return set.attribute("key") == variation.key; });
    xml::Element set = found != sets.end() ? *found : xml::Element(device).addChild("set", origin);
    set.setAttribute("key", variation.key, origin);
    set.setAttribute("value", variation.value, origin);
  }
  return document->text();
}

int reportVariations(const std::string& out, const std::vector<Variation>& variations, const Experiment& experiment) {
  terminal::JobProgress progress(variations.size() * static_cast<std::size_t>(variations.front().plan.studies));
  const std::vector<TrialSet> common = commonTrials(variations, experiment);
  Numbers numbers;
  for (const Variation& variation : variations) {
    auto found = numbersOf(variation.plan, common, progress);
    if (!found) return kExitInterrupted;
    numbers.push_back(std::move(*found));
  }
  progress.finish();
  writeFileAtomically(out + "/variations.csv", csvWith(variations, numbers));
  writeFileAtomically(out + "/variations.html",
                      pageOf(variations.front().plan, experiment, differences(variations, numbers)));
  print(variations, numbers, out);
  return kExitOk;
}

}  // namespace presa::experiment
