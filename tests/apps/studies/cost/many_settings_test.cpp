// A sweep of ten thousand settings: its page stays small enough to open.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <utility>
#include <vector>

#include "apps/common/report/page.h"
#include "apps/studies/cost/looks.h"
#include "apps/studies/cost/metrics.h"
#include "apps/studies/cost/report.h"
#include "framework/core/math/random.h"

namespace presa::cost {
namespace {

constexpr int kSide = 10;  ///< values of each of four knobs

Result sweep() {
  RandomStream random(1, "sweep");
  Result result;
  result.study.name = "sweep";
  result.study.title = "A sweep of four knobs";
  for (const char* knob : {"dynamics_rate", "haptic_rate", "substeps", "iterations"}) {
    result.study.factors.push_back({knob, {}});
    for (int i = 0; i < kSide; ++i) result.study.factors.back().values.push_back({std::to_string(i + 1), {}});
  }
  for (const Metric& metric : ownMetrics()) {
    if (result.metrics.size() < 12) result.metrics.push_back(metric.name);
  }
  result.study.sentences.push_back({.kind = SentenceRule::Kind::kFront, .metric = "force_rms"});
  result.study.sentences.push_back({.kind = SentenceRule::Kind::kFront, .metric = "proxy"});
  result.reference.noticeable["force_rms"] = 0.1;
  for (int k = 0; k < kSide * kSide * kSide * kSide; ++k) {
    Outcome& outcome = result.outcomes.emplace_back();
    double cost = 1;
    for (int knob = 0, rest = k; knob < 4; ++knob, rest /= kSide) {
      outcome.setting.choices.emplace_back(result.study.factors[static_cast<std::size_t>(knob)].name,
                                           std::to_string(rest % kSide + 1));
      cost += rest % kSide;
    }
    outcome.setting.name = k == 0 ? "default" : "setting " + std::to_string(k);
    if (random.uniform() < 0.05) outcome.failure = "cube was dropped";
    for (const std::string& metric : result.metrics)
      if (outcome.failure.empty()) outcome.error[metric] = std::exp(2 * random.uniform()) / cost;
    for (const double spread : {0.98, 1.0, 1.03}) {
      Timing timing;
      timing.per_second = 0.001 * cost * spread * (1 + 0.2 * random.uniform());
      outcome.timings.push_back(timing);
    }
  }
  return result;
}

TEST(ManySettings, MakeAPageThatOpens) {
  const std::string page = reportHtml(sweep());
  if (const char* file = std::getenv("PRESA_PAGE")) std::ofstream(file) << page;
  EXPECT_LT(page.size(), 8'000'000u);
}

// A label names the knob of a value that another knob has, too.
TEST(Looks, LabelsAreNotAmbiguous) {
  Result result;
  for (const auto& [voxel, spacing, law] :
       {std::array{"1", "1", "cone"}, {"2", "1", "cone"}, {"1", "2", "cone"}, {"1", "1", "dahl"}, {"2", "2", "cone"}}) {
    Outcome& outcome = result.outcomes.emplace_back();
    outcome.setting.choices = {{"voxel", voxel}, {"spacing", spacing}, {"law", law}};
  }
  const Looks looks = looksOf(result);
  const std::vector<std::string> expected{"default", "voxel 2", "spacing 2", "dahl", "2, 2"};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(looks.of[i].tag, expected[i]);
}

// Seven laws and three rates, whose effect is larger: shapes would repeat for the laws.
TEST(Looks, EveryValueHasItsOwn) {
  Result result;
  result.metrics = {"force_rms"};
  result.study.sentences.push_back({.kind = SentenceRule::Kind::kFront, .metric = "force_rms"});
  std::vector<std::pair<std::string, double>> rates{{"1000", 1}, {"2000", 2}, {"4000", 4}};
  for (const auto& [rate, cost] : rates) {
    for (int law = 0; law < 7; ++law) {
      Outcome& outcome = result.outcomes.emplace_back();
      outcome.setting.choices = {{"law", "law " + std::to_string(law)}, {"haptic_rate", rate}};
      outcome.error["force_rms"] = 1 / cost;
      Timing timing;
      timing.per_second = 0.001 * cost;
      outcome.timings.push_back(timing);
    }
  }
  std::set<std::pair<int, int>> looks;
  for (const Look& look : looksOf(result).of) looks.insert({look.color, look.shape});
  EXPECT_EQ(looks.size(), result.outcomes.size());
}

/// Relative luminance of a colour variable of the page, as WCAG defines it; the first of them is of the light theme.
double luminanceOf(const std::string& variable) {
  const std::string style = page::style();
  const auto color = std::stoul(style.substr(style.find(variable + ": #") + variable.size() + 3, 6), nullptr, 16);
  double sum = 0;
  for (const auto& [shift, weight] : {std::pair(16, 0.2126), {8, 0.7152}, {0, 0.0722}}) {
    const double part = static_cast<double>(color >> static_cast<unsigned>(shift) & 255U) / 255;
    sum += weight * (part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4));
  }
  return sum;
}

// Ten values of a knob: each has a colour of its own, and who sees no hues sees them get darker.
TEST(ManySettings, OfAKnobAreColouredAlongARamp) {
  const Looks looks = looksOf(sweep());
  double last = 2;
  for (int i = 0; i < kSide; ++i) {
    const svg::WorkFigure::Entry& entry = looks.legend[static_cast<std::size_t>(i)];
    EXPECT_TRUE(entry.label.ends_with(" " + std::to_string(i + 1))) << entry.label;
    ASSERT_GE(entry.color, svg::kRamp);
    const double luminance = luminanceOf("--r" + std::to_string(entry.color - svg::kRamp));
    EXPECT_LT(luminance, 0.95 * last);
    last = luminance;
  }
}

}  // namespace
}  // namespace presa::cost
