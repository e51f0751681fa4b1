#include <map>

#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/section.h"
#include "experiments/runner/statistics/correlation.h"
#include "experiments/runner/statistics/ranks.h"
#include "experiments/runner/statistics/resampling.h"

namespace presa::experiment::analysis {
namespace {

using statistics::SpearmanTest;
using terminal::format;

constexpr std::size_t kSubjectDraws = 2000;

/// Levels computed in different ways must tie in rank: see statistics::toLevels.
std::vector<double> leveled(const Context& context, const std::string& name, const std::vector<std::size_t>& rows) {
  return statistics::toLevels(context.trials.numbersOf(name, rows));
}

std::vector<int> strataOf(const Trials& trials, const NameList& within, const std::vector<std::size_t>& rows) {
  std::map<std::vector<std::size_t>, int> labels;
  std::vector<int> strata;
  for (const std::size_t row : rows) {
    std::vector<std::size_t> key;
    for (const std::string& name : within) {
      const Trials::Row& trial = trials.rows[row];
      key.push_back(name == "subject"   ? trial.subject
                    : name == "session" ? trial.session
                                        : static_cast<std::size_t>(trial.block));
    }
    strata.push_back(labels.try_emplace(key, static_cast<int>(labels.size())).first->second);
  }
  return strata;
}

/// The correlation with one factor: over all trials, then over each subject's own.
class OfOneFactor {
 public:
  OfOneFactor(const wanted::Spearman& what, const std::string& x, const Context& context)
      : what_(what), x_(x), context_(context), all_(context.trials.complete({what.y, x})) {}

  std::vector<std::vector<Cell>> rows() {
    std::vector<std::vector<Cell>> found{row("all", all_, true)};
    const Trials& trials = context_.trials;
    if (trials.subjects.size() < 2) return found;
    for (std::size_t s = 0; s < trials.subjects.size(); ++s) {
      std::vector<std::size_t> own;
      for (const std::size_t trial : all_) {
        if (trials.rows[trial].subject == s) own.push_back(trial);
      }
      found.push_back(row(trials.subjects[s], own, false));
    }
    return found;
  }

  std::optional<SpearmanTest> test;  ///< test over all trials; set by rows()
  std::optional<statistics::PermutationTest> permutation;

  /// The reported p value. Permutation within subjects is preferred: the trials of one person are not independent.
  double p() const { return permutation ? permutation->p : test->p; }

 private:
  std::vector<Cell> row(const std::string& subject, const std::vector<std::size_t>& rows, bool pooled) {
    const auto x = leveled(context_, x_, rows), y = leveled(context_, what_.y, rows);
    const auto found = statistics::spearmanTest(x, y, context_.confidence());
    std::vector<Cell> cells{subject, x_, static_cast<double>(rows.size())};
    if (found)
      cells.insert(cells.end(), {found->rho, found->interval, found->t, found->p});
    else
      cells.resize(cells.size() + 4);
    RandomStream random(context_.seed(), "permutation " + what_.y + " " + x_ + " " + subject);
    const auto shuffled = statistics::spearmanPermutation(x, y, strataOf(context_.trials, what_.within, rows),
                                                          what_.permutations, random);
    cells.push_back(cellOf(shuffled ? std::optional(shuffled->p) : std::nullopt));
    if (pooled) test = found, permutation = shuffled;
    if (context_.trials.subjects.size() >= statistics::kFewestSubjects)
      cells.push_back(pooled ? overSubjects() : Cell());
    return cells;
  }

  Cell overSubjects() const {
    const std::vector<double> x = leveled(context_, x_, all_), y = leveled(context_, what_.y, all_);
    const auto rho = [&](std::span<const std::size_t> drawn) {
      std::vector<double> some_x, some_y;
      for (const std::size_t i : drawn) some_x.push_back(x[i]), some_y.push_back(y[i]);
      return statistics::spearman(some_x, some_y);
    };
    RandomStream random(context_.seed(), "subjects " + what_.y + " " + x_);
    const auto found = statistics::bootstrapSubjects(context_.trials.subjectsOf(all_), rho, kSubjectDraws,
                                                     context_.confidence(), random);
    return cellOf(found.interval);
  }

  const wanted::Spearman& what_;
  std::string x_;
  const Context& context_;
  std::vector<std::size_t> all_;
};

std::string strengthOf(const SpearmanTest& test) {
  return "ρ = " + numberText(test.rho, "%.2f") + ", " + intervalText(test.interval, "%.2f");
}

std::string sentence(const std::string& y, const std::vector<std::string>& rises, const std::vector<std::string>& falls,
                     const std::vector<std::string>& open) {
  const auto joined = [](const std::vector<std::string>& parts) {
    std::string text;
    for (std::size_t i = 0; i < parts.size(); ++i)
      text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
    return text;
  };
  std::string text = y;
  if (!rises.empty()) text += " rises with " + joined(rises);
  if (!falls.empty()) text += (rises.empty() ? " falls with " : " and falls with ") + joined(falls);
  if (open.empty()) return text + ".";
  if (!rises.empty() || !falls.empty()) text += "; it";
  return text + " shows no monotone relation with " + joined(open) + ".";
}

}  // namespace

Section section(const wanted::Spearman& what, const Context& context) {
  Section section{"spearman", "Rank correlations of " + what.y,
                  "Spearman's correlation of exact mid-ranks; t with n - 2 degrees of freedom; " + context.percent() +
                      " interval of Bonett and Wright (2000)"};
  const std::size_t subjects = context.trials.subjects.size();
  if (what.permutations > 0) {
    std::string within;
    for (const std::string& name : what.within) within += (within.empty() ? "" : " and ") + name;
    section.method += format("; two-sided permutation p of %zu shuffles", what.permutations) +
                      (within.empty() ? "" : " within " + within);
  }
  Table table{"spearman_" + what.y,
              {{"subject"},
               {"x"},
               {"n", "", "%.0f"},
               {"rho", "", "%.3f"},
               {"interval", "", "%.3f"},
               {"t", "", "%.2f"},
               {"p", "", "p"},
               {"p_permutation", "", "p"}},
              {}};
  if (subjects >= statistics::kFewestSubjects) {
    table.columns.push_back({"interval_over_subjects", "", "%.3f"});
    section.method += format("; percentile interval of %zu bootstraps over subjects", kSubjectDraws);
  }
  std::vector<std::string> rises, falls, open;
  for (const std::string& x : what.x) {
    OfOneFactor factor(what, x, context);
    for (auto& row : factor.rows()) table.rows.push_back(std::move(row));
    if (!factor.test) continue;
    const bool shown = factor.p() < 1 - context.confidence();
    (shown ? factor.test->rho > 0 ? rises : falls : open).push_back(x + " (" + strengthOf(*factor.test) + ")");
  }
  if (!rises.empty() || !falls.empty() || !open.empty())
    section.finding.push_back(sentence(what.y, rises, falls, open));
  noteIncomplete(
      context,
      [&] {
        NameList all = what.x;
        all.push_back(what.y);
        return all;
      }(),
      section);
  if (subjects > 1)
    section.notes.push_back(
        format("In the rows of all, t, p and interval take %zu trials of %zu subjects for independent, "
               "which they are not; the permutation does not.",
               context.trials.size(), subjects));
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace presa::experiment::analysis
