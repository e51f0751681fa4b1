#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/section.h"
#include "experiments/runner/statistics/regression.h"

namespace presa::experiment::analysis {
namespace {

using statistics::Coefficient;
using statistics::LinearFit;
using terminal::format;

NameList with(const NameList& names, const std::string& last) {
  NameList all = names;
  all.push_back(last);
  return all;
}

std::vector<std::vector<double>> predictorsOf(const Trials& trials, const NameList& names,
                                              const std::vector<std::size_t>& rows) {
  std::vector<std::vector<double>> all;
  for (const std::string& name : names) all.push_back(trials.numbersOf(name, rows));
  return all;
}

void addGoodness(const LinearFit& fit, Section& section) {
  section.tables.push_back(
      {section.tables.front().id + "_fit",
       {{"n", "", "%.0f"}, {"df", "", "%.0f"}, {"residual_sd_of_ln"}, {"r_squared", "", "%.3f"}},
       {{static_cast<double>(fit.n), static_cast<double>(fit.df), fit.residual_sd, fit.r_squared}}});
}

std::string sentence(const statistics::ControlSlope& control, double alpha) {
  const Coefficient& slope = control.slope();
  const bool not_force = control.p_force < alpha, not_depth = slope.p < alpha;
  return std::string(slope.value < -0.75   ? "Rather a force was held than a depth"
                     : slope.value > -0.25 ? "Rather a depth was held than a force"
                                           : "Neither a force was held nor a depth") +
         ": the slope of ln depth on ln stiffness is " + numberText(slope.value, "%.2f") + " (" +
         intervalText(slope.interval, "%.2f") + "), " +
         (not_force && not_depth ? "told apart from both"
          : not_depth            ? "not told apart from"
          : not_force            ? "told apart from"
                                 : "told apart neither from") +
         " −1, a held force, " +
         (not_force && not_depth ? "and 0, a held depth."
          : not_depth            ? "but from 0, a held depth."
          : not_force            ? "but not from 0, a held depth."
                                 : "nor from 0, a held depth.");
}

constexpr const char* kNoFit =
    "There is no fit: it takes values above 0, predictors that vary and do not depend on each other, and more trials "
    "than "
    "predictors and subjects.";

}  // namespace

Section section(const wanted::LogLinear& what, const Context& context) {
  Section section{"log_linear", "Exponents of " + what.y,
                  "least squares of ln " + what.y + " on the ln of the predictors, one constant per subject; " +
                      context.percent() + " t intervals; p against an exponent of 0"};
  const std::vector<std::size_t> rows = context.trials.complete(with(what.x, what.y));
  const auto predictors = predictorsOf(context.trials, what.x, rows);
  const auto y = context.trials.numbersOf(what.y, rows);
  const auto fit = statistics::logLinear(y, predictors, context.trials.subjectsOf(rows), context.confidence());
  Table table{"log_linear_" + what.y,
              {{"predictor"},
               {"exponent", "", "%.3f"},
               {"interval", "", "%.3f"},
               {"standard_error", "", "%.3f"},
               {"t", "", "%.2f"},
               {"p", "", "p"},
               {"n", "", "%.0f"}},
              {}};
  if (!fit) {
    section.notes.emplace_back(kNoFit);
    section.tables.push_back(std::move(table));
    return section;
  }
  std::string product;
  for (std::size_t i = 0; i < what.x.size(); ++i) {
    const Coefficient& c = fit->coefficients[i];
    table.rows.push_back({what.x[i], c.value, c.interval, c.standard_error, c.t, c.p, static_cast<double>(fit->n)});
    product += (i > 0 ? " · " : "") + what.x[i] + "^" + numberText(c.value, "%.2f");
  }
  section.finding.push_back(what.y + " goes as " + product + format(" (R² = %.2f within subjects).", fit->r_squared));
  section.tables.push_back(std::move(table));
  addGoodness(*fit, section);
  noteIncomplete(context, with(what.x, what.y), section);
  return section;
}

Section section(const wanted::DepthControl& what, const Context& context) {
  Section section{"depth_control", "Was a force held, or a depth?",
                  "slope of ln(" + what.force + " / " + what.stiffness + ") on ln " + what.stiffness +
                      ", one constant per subject: -1 where the force is held, 0 where the depth is; " +
                      context.percent() + " t interval"};
  const NameList used = with(with(what.x, what.force), what.stiffness);
  const std::vector<std::size_t> rows = context.trials.complete(used);
  const auto others = predictorsOf(context.trials, what.x, rows);
  const auto control = statistics::controlSlope(context.trials.numbersOf(what.force, rows),
                                                context.trials.numbersOf(what.stiffness, rows), others,
                                                context.trials.subjectsOf(rows), context.confidence());
  Table table{"depth_control_" + what.force,
              {{"slope", "", "%.3f"},
               {"interval", "", "%.3f"},
               {"t_against_force", "", "%.2f"},
               {"p_against_force", "", "p"},
               {"t_against_depth", "", "%.2f"},
               {"p_against_depth", "", "p"},
               {"n", "", "%.0f"}},
              {}};
  if (!control) {
    section.notes.emplace_back(kNoFit);
    section.tables.push_back(std::move(table));
    return section;
  }
  const Coefficient& slope = control->slope();
  table.rows.push_back({slope.value, slope.interval, control->t_force, control->p_force, slope.t, slope.p,
                        static_cast<double>(control->fit.n)});
  section.finding.push_back(sentence(*control, 1 - context.confidence()));
  section.tables.push_back(std::move(table));
  addGoodness(control->fit, section);
  noteIncomplete(context, used, section);
  return section;
}

}  // namespace presa::experiment::analysis
