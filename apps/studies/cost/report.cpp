#include "apps/studies/cost/report.h"

#include "apps/common/report/html.h"
#include "apps/common/report/page.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/studies/cost/analysis.h"
#include "apps/studies/cost/knob_plots.h"
#include "apps/studies/cost/report_tables.h"
#include "apps/studies/cost/verdict.h"
#include "apps/studies/cost/work_plots.h"

namespace presa::cost {
namespace {

using html::folded;
using html::row;
using svg::escape;
using terminal::format;

std::string finePrint(const Result& result) {
  const Study& study = result.study;
  const auto fact = [](const std::string& name, const std::string& html) { return row({escape(name), html}); };
  std::string rows = fact("scene", "<code>" + escape(study.inputs.scene) + "</code>");
  std::string reference;
  if (study.reference_kind == Study::Reference::kAnalytic) reference = "the analytic answer";
  if (study.reference_kind == Study::Reference::kNone)
    reference = "none is needed: a perfect run has zero of each error";
  if (study.reference_kind == Study::Reference::kRefined) {
    reference = "<code>" + escape(setOptions(result.reference.sets)) +
                "</code>. It differs from the next coarser one by " +
                (result.reference.fine_enough
                     ? "less than a tenth of the smallest error shown."
                     : "more than a tenth of some errors: those are marked ≲, below the reference's resolution.");
  }
  for (const std::string& knob : result.reference.kept)
    reference +=
        " It keeps <code>" + escape(knob) +
        "</code>, because it cannot be run with a finer value: the error of that knob is not in the difference.";
  rows += fact("reference", reference);
  rows += fact(
      "repeats",
      format("%d timed runs of each setting, one at a time, without a recording; errors come from a run of their own",
             study.repeats));
  rows += fact("clock", "processor time of the thread, its own cost taken off");
  rows += fact("seed", std::to_string(study.seed));
  for (const auto& [name, value] : result.machine) rows += fact(name, escape(value));
  return "<div class=\"scroll\"><table class=\"facts\"><tbody>\n" + rows +
         "</tbody></table></div>\n<h3>Repeat this study</h3>\n<pre><code>" + escape(result.command) + "</code></pre>\n";
}

std::string verdictBlock(const Result& result) {
  const Verdict verdict = verdictOf(result);
  using Kind = Verdict::Kind;
  const bool good = verdict.kind == Kind::kOnFront || verdict.kind == Kind::kNear;
  const bool bad = (verdict.kind == Kind::kBeaten && !verdict.unfelt) || !result.outcomes.front().failure.empty();
  std::string out = std::string("<div class=\"verdict ") +
                    (good  ? "good"
                     : bad ? "bad"
                           : "neutral") +
                    "\"><b>" + escape(verdict.headline) + "</b>\n";
  for (std::size_t i = 0; i < verdict.details.size(); ++i) {
    out += "<p>" + escape(verdict.details[i]) + "</p>\n";
    if (i > 0 || !verdict.better) continue;
    out += "<p>To take it: <code>" + escape(setOptions(result.outcomes[*verdict.better].setting.sets)) +
           "</code>; or <code>--resume --apply FILE</code> added to the command of this study writes the scene with "
           "these values.</p>\n";
  }
  return out + "</div>\n";
}

std::string inWords(const Result& result) {
  std::string out;
  for (const std::string& text : sentences(result)) out += "<p>" + escape(text) + "</p>\n";
  return out;
}

}  // namespace

std::string reportHtml(const Result& result) {
  std::string out = page::head(result.study.title + " – Presa") + "<h1>" + escape(result.study.title) + "</h1>\n";
  if (!result.study.description.empty()) out += "<p class=\"lead\">" + escape(result.study.description) + "</p>\n";
  out += verdictBlock(result) + workPlots(result) + "<h2>More</h2>\n";
  out += folded("In words", inWords(result));
  out += folded("How far the default is from the front", frontDistances(result));
  out += folded("The cheapest setting that nobody feels", choice(result));
  out += folded("Other errors over cost", otherPlots(result));
  out += folded("Error over each knob", knobPlots(result));
  out += folded("What one knob buys", gains(result));
  out += folded("All settings", settings(result));
  out += folded("Decimated meshes", meshes(result));
  out += folded("Fine print", finePrint(result));
  return out + page::tail();
}

}  // namespace presa::cost
