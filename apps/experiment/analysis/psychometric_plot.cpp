#include <algorithm>
#include <cmath>

#include "apps/common/report/svg_facets.h"
#include "apps/common/terminal/text.h"
#include "apps/experiment/analysis/psychometric_fit.h"

namespace presa::experiment::analysis {
namespace {

using statistics::Interval;
using statistics::PsychometricFunction;
using statistics::StimulusLevel;
using svg::FacetPoint;
using svg::Layer;
using terminal::format;

constexpr std::size_t kMaxFacetRows = 6;  ///< with more subjects only all together are drawn

std::vector<Layer> layersOf(const wanted::Psychometric& what, const Fit& fit, int color) {
  Layer data{Layer::Kind::kSymbols, color, false, {}}, curve{Layer::Kind::kLine, color, false, {}},
      band{Layer::Kind::kArea, color, false, {}};
  double max = 1;
  for (const StimulusLevel& level : fit.levels) max = std::max(max, static_cast<double>(level.trials));
  for (const StimulusLevel& level : fit.levels) {
    FacetPoint point{level.x, static_cast<double>(level.hits) / level.trials};
    point.size = 0.5 + std::sqrt(level.trials / max);
    point.label = format("%s %.4g: %d of %d", what.x.c_str(), level.x, level.hits, level.trials);
    data.points.push_back(std::move(point));
  }
  if (!fit.result.fit) return {data};
  const PsychometricFunction& f = fit.result.fit->function;
  const double low = fit.levels.front().x, high = fit.levels.back().x;
  for (int i = 0; i <= 100; ++i) {
    const double x = low + (high - low) * i / 100;
    curve.points.push_back({x, f.probability(x)});
  }
  Layer threshold{Layer::Kind::kSymbols, -1, false, {}};
  if (fit.bootstrap) {
    const std::vector<double> proportions = bandOf(what.model);
    for (std::size_t i = 0; i < proportions.size(); ++i) {
      const Interval& at = fit.bootstrap->thresholds[i];
      FacetPoint point{std::clamp(at.low, low, high), proportions[i]};
      point.left = std::clamp(at.low, low, high), point.right = std::clamp(at.high, low, high);
      band.points.push_back(std::move(point));
    }
    if (const auto x = f.threshold(what.threshold)) {
      FacetPoint point{*x, what.threshold};
      point.left = fit.bootstrap->thresholds.back().low, point.right = fit.bootstrap->thresholds.back().high,
      point.size = 0.7;
      threshold.points.push_back(std::move(point));
    }
  }
  return {band, curve, data, threshold};
}

std::string headOf(const wanted::Psychometric& what, const Fit& fit) {
  std::string head;
  for (std::size_t i = 0; i < what.by.size(); ++i) head += (i > 0 ? ", " : "") + what.by[i] + " " + fit.group.levels[i];
  return head;
}

/// Index of a name in a list; the name is appended if it is missing.
std::size_t placeOf(const std::string& name, std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<std::size_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return place;
}

/// "ln(mu_s / standard)" for a level that a method chose, else the name of the variable, with its unit.
std::string xLabel(const wanted::Psychometric& what, const Context& context) {
  const Stimulus stimulus(what, context.experiment);
  if (!stimulus.column()) return context.heading(what.x);
  const std::string &name = stimulus.column()->name, &unit = stimulus.column()->unit;
  const auto sized = [&](const std::string& text) { return stimulus.folded() ? "|" + text + "|" : text; };
  switch (context.experiment.procedure->stimulus.axis.unit) {
    case psychophysics::Unit::kLinear:
      return sized(name + " - standard") + " [" + (unit.empty() ? "1" : unit) + "]";
    case psychophysics::Unit::kLnRatio:
      return sized("ln(" + name + " / standard)") + " [1]";
    case psychophysics::Unit::kDecibel:
      return sized("20 lg(" + name + " / standard)") + " [dB]";
  }
  return context.heading(what.x);
}

/// What a positive answer means.
std::string yLabel(const wanted::Psychometric& what, const Context& context) {
  const auto& procedure = context.experiment.procedure;
  if (what.y != "positive" || !procedure) return "proportion of " + what.y + " [1]";
  if (procedure->task == Task::kYesNo) return "proportion of yes answers [1]";
  return procedure->coding == psychophysics::Coding::kCorrect ? "proportion of right answers [1]"
                                                              : "proportion of answers “greater” [1]";
}

std::string withoutUnit(const std::string& label) { return label.substr(0, label.rfind(" [")); }

}  // namespace

std::string titleOf(const wanted::Psychometric& what, const Context& context) {
  return "Psychometric function: " + withoutUnit(yLabel(what, context)) + " over " + withoutUnit(xLabel(what, context));
}

std::string figureOf(const wanted::Psychometric& what, const Context& context, const std::vector<Fit>& fits) {
  const std::size_t subjects = context.trials.subjects.size();
  const bool pooled = subjects > kMaxFacetRows;
  svg::FacetFigure figure{"Psychometric functions", xLabel(what, context), yLabel(what, context), {}, {}};
  struct Placed {
    const Fit* fit;
    std::size_t row, column;
  };
  std::vector<Placed> drawn;
  for (const Fit& fit : fits) {
    if (subjects > 1 && (fit.subject == "all") != pooled) continue;
    const std::string row = pooled ? "all subjects" : subjects > 1 || !what.by.empty() ? fit.subject : "";
    const std::size_t at = placeOf(row, figure.rows);
    drawn.push_back({&fit, at, placeOf(headOf(what, fit), figure.columns)});
  }
  if (drawn.empty()) return {};
  figure.facets.resize(figure.rows.size() * figure.columns.size());
  for (const Placed& one : drawn)
    figure.facets[one.row * figure.columns.size() + one.column].layers = layersOf(what, *one.fit, 1);
  figure.y_max = 1;
  figure.legend = {{"answers, larger: more trials", Layer::Kind::kSymbols, 1}, {"fit", Layer::Kind::kLine, 1}};
  if (what.draws > 0) figure.legend.push_back({context.percent() + " interval", Layer::Kind::kArea, 1});
  return svg::render(figure);
}

}  // namespace presa::experiment::analysis
