#include "apps/common/report/page.h"

#include <algorithm>
#include <string_view>

#include "apps/common/report/html.h"
#include "apps/common/report/svg_plot.h"
#include "apps/common/terminal/text.h"
#include "apps/common/version.h"
#include "apps/experiment/analysis/analyse.h"

namespace presa::experiment::analysis {
namespace {

using svg::escape;
using terminal::format;

/// Turns exponents, written x^0.5, into superscripts.
std::string sentenceHtml(const std::string& sentence) {
  const std::string text = escape(sentence);
  std::string html;
  std::size_t done = 0;
  for (std::size_t at = text.find('^'); at != std::string::npos; at = text.find('^', at + 1)) {
    std::size_t digits = at + 1;
    for (const std::string_view minus : {"−", "-"}) {
      if (text.compare(digits, minus.size(), minus) != 0) continue;
      digits += minus.size();
      break;
    }
    const std::size_t end = std::min(text.find_first_not_of("0123456789.", digits), text.size());
    if (end == digits) continue;
    html += text.substr(done, at - done) + "<sup>" + text.substr(at + 1, end - at - 1) + "</sup>";
    done = end;
  }
  return html + text.substr(done);
}

std::string banner(const Trials& trials) {
  if (trials.model().empty()) return {};
  std::size_t simulated = 0;
  for (const SessionCensus& session : trials.sessions) simulated += session.model.empty() ? 0 : 1;
  const std::string how_many = simulated == trials.sessions.size()
                                   ? "All sessions were simulated"
                                   : format("%zu of %zu sessions were simulated", simulated, trials.sessions.size());
  const bool is_model = trials.model().find("a model, not a person") != std::string::npos;
  return "<div class=\"verdict bad\"><b>" + std::string(is_model ? "A model, not a person" : "Not a person") +
         "</b>\n<p>" + how_many + ": " + escape(trials.model()) +
         ". Nothing on this page says how people behave.</p></div>\n";
}

std::string findings(const Result& result) {
  std::string out;
  for (const std::string& sentence : result.headlines()) out += "<p>" + sentenceHtml(sentence) + "</p>\n";
  for (const std::string& note : result.notes) out += "<p class=\"caption\">" + escape(note) + "</p>\n";
  return out.empty() ? out : "<div class=\"verdict\">\n" + out + "</div>\n";
}

std::string tile(const char* label, std::size_t value) {
  return "<div class=\"tile\"><span>" + std::string(label) + "</span><strong>" + std::to_string(value) +
         "</strong></div>\n";
}

std::string tiles(const Trials& trials) {
  std::size_t excluded = 0, missing = 0;
  for (const SessionCensus& session : trials.sessions) excluded += session.excluded, missing += session.missing;
  return "<div class=\"tiles\">\n" + tile("subjects", trials.subjects.size()) +
         tile("sessions", trials.sessions.size()) + tile("trials that count", trials.size()) +
         tile("excluded", excluded) + tile("missing", missing) + "</div>\n";
}

std::string census(const Trials& trials) {
  std::string rows;
  for (const SessionCensus& s : trials.sessions)
    rows += html::row({escape(s.subject), std::to_string(s.session), s.complete ? "complete" : "not finished",
                       std::to_string(s.planned), std::to_string(s.counted), std::to_string(s.excluded),
                       std::to_string(s.missing), std::to_string(s.aborted), std::to_string(s.cut_off),
                       std::to_string(s.practice)});
  std::string out =
      "<h2>Data</h2>\n" + html::table({"subject", "session", "", "planned", "count", "excluded", "missing",
                                       "aborted runs", "interrupted runs", "practice, left out"},
                                      rows);
  if (trials.left_out.empty()) return out;
  rows.clear();
  for (const LeftOut& one : trials.left_out)
    rows += html::row(
        {escape(one.subject), std::to_string(one.session), std::to_string(one.trial), one.what, escape(one.why)});
  return out + "<details" + (trials.left_out.size() <= 12 ? " open" : "") +
         "><summary>Trials that do not count, and why</summary>\n" +
         html::table({"subject", "session", "trial", "", "why"}, rows) + "</details>\n";
}

std::string sectionHtml(const Section& section) {
  std::string out = "<h2>" + escape(section.title) + "</h2>\n";
  for (const std::string& sentence : section.finding) out += "<p>" + sentenceHtml(sentence) + "</p>\n";
  out += section.figure;
  if (!section.figure_caption.empty()) out += "<p class=\"caption\">" + escape(section.figure_caption) + "</p>\n";
  for (const Table& table : section.tables) out += htmlOf(table);
  if (!section.method.empty()) out += "<p class=\"caption\">Method: " + escape(section.method) + ".</p>\n";
  for (const std::string& note : section.notes) out += "<p class=\"caption\">" + escape(note) + "</p>\n";
  return out;
}

std::string finePrint(const Result& result) {
  const Analysis& analysis = result.experiment.analysis;
  const auto fact = [](const std::string& name, const std::string& value) { return html::row({name, escape(value)}); };
  std::string rows =
      fact("data", result.data) + fact("analysis", result.analysis_file) +
      fact("confidence", format("%.4g %% unless said otherwise", 100 * analysis.confidence)) +
      fact("random numbers",
           format("seed %llu, a stream of its own for each test", static_cast<unsigned long long>(analysis.seed))) +
      fact("numbers", "analysis.json and tables/*.csv beside this page hold all of them, with all digits") +
      fact("Presa", versionText());
  return "<h2>Fine print</h2>\n<div class=\"scroll\"><table class=\"facts\"><tbody>\n" + rows +
         "</tbody></table></div>\n";
}

}  // namespace

std::string reportHtml(const Result& result) {
  const Experiment& experiment = result.experiment;
  const std::string title = experiment.title.empty() ? experiment.name : experiment.title;
  std::string out = page::head(title + " – Presa") + "<h1>" + escape(title) + "</h1>\n<p class=\"lead\">" +
                    escape(experiment.description) + "</p>\n" + banner(result.trials) + findings(result) +
                    tiles(result.trials);
  for (const Section& section : result.sections) out += sectionHtml(section);
  return out + census(result.trials) + finePrint(result) + page::tail();
}

}  // namespace presa::experiment::analysis
