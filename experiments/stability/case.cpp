#include "experiments/stability/case.h"

#include <cmath>
#include <cstdio>

#include "experiments/study/experiment_file.h"

namespace presa::stability {
const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kStable:
      return "stable";
    case Verdict::kDrift:
      return "drift";
    case Verdict::kUnstable:
      return "unstable";
    case Verdict::kFailed:
      return "failed";
  }
  return "failed";
}

Verdict judge(double value, double bound) {
  const double size = std::abs(value);
  if (!std::isfinite(size)) return Verdict::kUnstable;
  if (size <= bound) return Verdict::kStable;
  return size <= 10 * bound ? Verdict::kDrift : Verdict::kUnstable;
}

Finding finding(std::string metric, double value, std::string unit, double bound, std::string oracle) {
  return {std::move(metric), value, std::move(unit), bound, std::move(oracle), judge(value, bound), {}, {}, {}};
}

Curve decimated(Curve curve, std::size_t max) {
  const std::size_t count = curve.x.size();
  if (count <= max) return curve;
  Curve kept{std::move(curve.label), {}, {}};
  for (std::size_t i = 0; i < max; ++i) {
    const std::size_t from = i * (count - 1) / (max - 1);
    kept.x.push_back(curve.x[from]);
    kept.y.push_back(curve.y[from]);
  }
  return kept;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string sceneFile(const std::string& name) { return experimentFile("stability/scenes/" + name); }

StudySpec specOf(const std::string& scene, std::vector<std::string> sets, double duration, double trace_rate) {
  StudySpec spec;
  spec.scene = sceneFile(scene);
  spec.sets = std::move(sets);
  spec.duration = duration;
  spec.trace_rate = trace_rate;
  return spec;
}

}  // namespace presa::stability
