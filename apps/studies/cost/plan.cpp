#include "apps/studies/cost/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "apps/studies/cost/condition_factor.h"
#include "apps/studies/cost/factors.h"
#include "apps/studies/cost/finer_knobs.h"
#include "apps/studies/cost/identity.h"
#include "apps/studies/cost/metrics.h"
#include "apps/studies/cost/reference_levels.h"
#include "apps/studies/cost/trace.h"
#include "framework/input/folders.h"

namespace presa::cost {
namespace {

/// Parses NAME=v1,v2.
Factor parseFactor(const std::string& text, const Scene& scene, const std::string& folder, Diagnostics& diagnostics) {
  const SourceLocation where{"--knob " + text, 0, 0};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    diagnostics.error(802, where, "expected NAME=VALUE,VALUE…, found " + quote(text),
                      "for example --knob dynamics_rate=100,200,500");
    return {};
  }
  std::vector<std::string> values{""};
  for (const char c : text.substr(equals + 1)) {
    if (c == ',')
      values.emplace_back();
    else
      values.back() += c;
  }
  return makeFactor(text.substr(0, equals), values, scene, folder, where, diagnostics);
}

constexpr std::size_t kManyBodies = 2;  // more that move are slow to step
constexpr int kLowestRate = 1250;       // of a level [Hz]

std::size_t movingBodies(const Loaded& base) {
  const auto moving = std::ranges::count_if(base.world->scene.bodies, [](const Body& body) { return !body.fixed; });
  return static_cast<std::size_t>(moving);
}

/// Haptic rates of the reference's levels [Hz]. A quick study has two for many bodies and for tools, three for meshes,
/// and lower ones for a heap, so that it takes 20 s at most.
std::vector<int> levelRates(const Loaded& base, bool quick) {
  constexpr double kSteps = 250'000;  // of one body, which takes 20 to 40 us
  std::vector<int> rates{5000, 10000, 20000, 40000};
  if (!quick) return rates;
  const std::size_t moving = movingBodies(base);
  const bool two = moving > kManyBodies || base.world->scene.hasTools();
  rates.resize(two ? 2 : base.plan.has("collision_fcl") ? 3 : 4);
  const auto steps = [&] { return static_cast<double>(moving) * base.options.duration * rates.back(); };
  while (moving > kManyBodies && steps() > kSteps && rates.front() > kLowestRate)
    for (int& rate : rates) rate /= 2;
  return rates;
}

/// Whether ticks of `rate` fall on those of the haptic thread.
bool fits(double haptic, double rate) { return std::abs(haptic / rate - std::round(haptic / rate)) < 1e-9; }

std::vector<std::vector<std::string>> defaultReference(const Loaded& base, bool quick) {
  const Scene& scene = base.world->scene;
  const bool motion = hasMotion(base.plan), meshes = base.plan.has("collision_fcl");
  std::vector<std::vector<std::string>> levels;
  for (const int rate : levelRates(base, quick)) {
    std::vector<std::string>& sets = levels.emplace_back();
    sets.push_back("rates/haptic=" + std::to_string(rate));
    if (motion || !fits(rate, scene.rates.dynamics)) sets.push_back("rates/dynamics=" + std::to_string(rate));
    if (meshes || !fits(rate, scene.rates.collision))
      sets.push_back("rates/collision=" + std::to_string(std::min(rate, 2500)));
  }
  return levels;
}

void checkMetrics(const std::vector<std::string>& names, Diagnostics& diagnostics) {
  for (const std::string& name : names) {
    if (findMetric(name) != nullptr) continue;
    std::string list;
    for (const std::string& each : metricNames()) list += (list.empty() ? "" : ", ") + each;
    diagnostics.error(804, {"--metric " + name, 0, 0},
                      "there is no metric " + quote(name) + didYouMean(name, metricNames()), "metrics: " + list);
  }
}

std::vector<SentenceRule> defaultSentences(const Study& study) {
  std::vector<SentenceRule> rules;
  const auto has = [&](const char* name) {
    return std::find(study.metrics.begin(), study.metrics.end(), name) != study.metrics.end();
  };
  for (const char* metric : {"force_rms_jnd", "position"}) {
    if (!has(metric)) continue;
    rules.push_back({.kind = SentenceRule::Kind::kBelow, .metric = metric});
    rules.push_back({.kind = SentenceRule::Kind::kCheapest, .metric = metric});
  }
  for (const char* metric : {"force_rms", "position", "penetration"}) {
    if (has(metric)) rules.push_back({.kind = SentenceRule::Kind::kFront, .metric = metric});
  }
  for (const Factor& factor : study.factors) {
    if (factor.name == "dynamics_rate" && has("force_rms"))
      rules.push_back({.kind = SentenceRule::Kind::kHalving, .metric = "force_rms", .factor = factor.name});
    const char* metric = has("force_rms") ? "force_rms" : has("position") ? "position" : nullptr;
    if (factor.finer != Direction::kNone && metric != nullptr)
      rules.push_back({.kind = SentenceRule::Kind::kOrder, .metric = metric, .factor = factor.name});
  }
  rules.push_back({.kind = SentenceRule::Kind::kFailures});
  return rules;
}

/// The levels, which the settings must be known for: the reference is finer than all of them.
void planReference(Study& study, const Loaded& base, bool quick, Diagnostics& diagnostics) {
  if (study.reference_kind != Study::Reference::kRefined) return study.reference.clear();
  if (study.reference.empty()) {
    study.reference = defaultReference(base, quick);
    study.finer = finerSets(base.world->scene, study.factors, study.reference.size());
  }
  for (std::size_t level = 0; level < study.reference.size(); ++level)
    checkedScene(study.inputs, setsOfLevel(study, level, noLimits(study)), study.folder, diagnostics);
}

/// Bytes of the traces of all runs, which are kept until the study ends.
double diskBytes(const Study& study, const Loaded& base, const std::optional<Shard>& shard) {
  const Scene& scene = base.world->scene;
  const auto fingers = static_cast<double>(scene.devices.size());
  const auto free =
      static_cast<double>(std::ranges::count_if(scene.bodies, [](const Body& body) { return !body.fixed; }));
  const auto bytesAt = [&](double haptic_rate) {
    const double instants =
        1000 * (sizeof(std::int64_t) + 1 + fingers * sizeof(FingerSample) + free * sizeof(BodySample));
    return base.options.duration * (instants + haptic_rate * (sizeof(std::int64_t) + fingers * 3 * sizeof(float)));
  };
  double bytes = static_cast<double>(study.settings.size()) * bytesAt(scene.rates.haptic);
  for (const std::vector<std::string>& level : study.reference) {
    double rate = scene.rates.haptic;
    for (const std::string& set : level)
      if (set.starts_with("rates/haptic=")) rate = std::strtod(set.c_str() + set.find('=') + 1, nullptr);
    bytes += bytesAt(rate);
  }
  return shard ? bytes / shard->count : bytes;
}

/// True for a single free body without any other body or finger to touch: its motion is known analytically.
bool isAlone(const Loaded& base) {
  const auto& bodies = base.world->scene.bodies;
  const bool solid =
      std::count_if(bodies.begin(), bodies.end(), [](const Body& body) { return body.physics.has_value(); }) == 1;
  return solid && base.world->scene.devices.empty() && hasMotion(base.plan);
}

}  // namespace

void chooseFolder(const Request& request, Study& study) {
  std::string folder = request.out.empty() ? "cost_" + study.name : request.out;
  if (request.out.empty() && request.shard)
    folder += "_" + std::to_string(request.shard->index) + "_of_" + std::to_string(request.shard->count);
  study.folder = std::filesystem::absolute(folder).lexically_normal().string();
  input::allowFolder(study.folder);  // allows reading the meshes that the study writes
}

Study planStudy(const Request& request, Diagnostics& diagnostics) {
  Study study;
  std::vector<std::vector<Factor>> grids;
  if (isStudyFile(request.input)) {
    grids = readStudyFile(request.input, request, study, diagnostics);
    if (study.inputs.scene.empty()) return study;
  } else {
    study.inputs = {request.input, request.rig, request.sets};
  }
  if (request.duration > 0) study.duration = request.duration;
  if (request.seed > 0) study.seed = request.seed;
  if (request.quick) study.repeats = std::min(study.repeats, 2);
  if (!request.metrics.empty()) study.metrics = request.metrics;
  checkMetrics(study.metrics, diagnostics);

  refuseConditions(study.inputs.sets, {study.file.empty() ? "--set" : study.file, 0, 0}, diagnostics);
  RunOptions options;
  options.duration = study.duration;
  const Loaded base = loadWorld(study.inputs, options, diagnostics);
  if (!base.world) return study;
  const Scene& scene = base.world->scene;
  if (study.name.empty()) study.name = scene.name;
  chooseFolder(request, study);
  if (study.title.empty()) study.title = "What accuracy costs: " + scene.name;
  if (study.metrics.empty())
    for (const Metric& metric : ownMetrics()) study.metrics.push_back(metric.name);
  if (study.reference_kind == Study::Reference::kNone) {
    std::erase_if(study.metrics, [](const std::string& name) {
      const Metric* metric = findMetric(name);
      return metric != nullptr && !metric->absolute;
    });
  }
  using Reference = Study::Reference;
  if (study.file.empty() && isAlone(base)) study.reference_kind = Reference::kAnalytic;

  const bool hands_off = scene.devices.empty() && hasMotion(base.plan);
  if (study.reference_kind == Reference::kAnalytic && !hands_off)
    diagnostics.error(808, {study.file, 0, 0}, "an analytic reference is for scenes of free bodies without fingers",
                      "leave the reference out, or give its levels");
  if (!request.factors.empty()) {
    grids.clear();
    std::vector<Factor>& grid = grids.emplace_back();
    for (const std::string& text : request.factors) grid.push_back(parseFactor(text, scene, study.folder, diagnostics));
    std::erase_if(grid, [](const Factor& factor) { return factor.values.empty(); });
  }
  for (const std::vector<Factor>& grid : grids)
    for (const Factor& factor : grid)
      checkUse(factor, base, {request.factors.empty() ? study.file : "--knob " + factor.name, 0, 0}, diagnostics);
  if (base.world->scene.bodies.empty()) return study;  // unreadable scene: reported above
  if (grids.empty()) {
    addSettings(study, defaultFactors(base, study.folder, request.quick), Combine::kOneAtATime, diagnostics);
  } else {
    for (const std::vector<Factor>& grid : grids) {
      if (!grid.empty()) addSettings(study, grid, Combine::kGrid, diagnostics);
    }
  }
  if (!diagnostics.hasErrors() && study.settings.size() < 2) {
    diagnostics.error(805, {request.input, 0, 0},
                      "there is nothing to compare: no setting differs from the scene as it stands",
                      "name knobs with --knob NAME=VALUE,VALUE");
  }
  for (Factor& factor : study.factors) factor.finer = directionOf(factor.name, scene);
  planReference(study, base, request.quick, diagnostics);
  study.disk_bytes = diskBytes(study, base, request.shard);
  nameSettings(study);
  if (study.sentences.empty()) study.sentences = defaultSentences(study);
  return study;
}

}  // namespace presa::cost
