// A sweep of ten thousand settings: its page stays small enough to open.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

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

}  // namespace
}  // namespace presa::cost
