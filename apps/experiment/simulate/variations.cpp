#include "apps/experiment/simulate/variations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

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

/// All numbers of the studies of a variation; none when interrupted.
std::optional<std::vector<Spread>> numbersOf(const StudiesPlan& plan, terminal::JobProgress& progress) {
  StudyNumbers numbers;
  for (int study = 1; study <= plan.studies; ++study) {
    const auto go_on = [&](std::size_t, std::size_t, const std::string&) {
      progress.show();
      return !terminal::JobProgress::interrupted();
    };
    const analysis::Result result = analysis::analyse(
        {plan.out + format("/study-%03d", study), plan.experiment_file, static_cast<std::size_t>(plan.subjects)},
        go_on);
    if (result.interrupted) return std::nullopt;
    numbers.add(study, result);
    progress.done(format("analysis of study %d", study));
  }
  return numbers.spreads();
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

using Numbers = std::vector<std::vector<Spread>>;  // of each variation

/// One row for each variation: every shown number and its difference from the first variation.
Table differences(const std::vector<Variation>& variations, const Numbers& numbers) {
  Table table{"variations", {{"variation"}}, {}};
  for (const Spread& one : numbers.front()) {
    if (!isShown(one, numbers.front())) continue;
    table.columns.push_back({one.row, "", "%.3f"});
    table.columns.push_back({"difference", "", "%+.3f"});
  }
  for (std::size_t v = 0; v < variations.size(); ++v) {
    std::vector<Cell> row{variations[v].name()};
    for (const Spread& given : numbers.front()) {
      if (!isShown(given, numbers.front())) continue;
      const Spread* here = sameIn(numbers[v], given);
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
    for (const Spread& one : numbers[v])
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
             "with "
             "one setting changed; same subjects, same order of trials.",
             plan.studies, plan.studies == 1 ? "study" : "studies", plan.subjects,
             plan.subjects == 1 ? "subject" : "subjects") +
         "</p>\n" + htmlOf(table) + "<div class=\"verdict neutral\"><b>A model, not a person</b>\n<p>" +
         svg::escape(experiment.model) + ".</p></div>\n" + page::tail();
}

void print(const std::vector<Variation>& variations, const Numbers& numbers, const std::string& out) {
  for (std::size_t v = 0; v < variations.size(); ++v) {
    std::string line = format("  %-28s", variations[v].name().c_str());
    for (const Spread& given : numbers.front()) {
      const Spread* here = isShown(given, numbers.front()) ? sameIn(numbers[v], given) : nullptr;
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
  Numbers numbers;
  for (const Variation& variation : variations) {
    auto found = numbersOf(variation.plan, progress);
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
