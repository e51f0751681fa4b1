#include "devices/falcon_model/force_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "devices/falcon_model/legs.h"

namespace presa::falcon_model {
namespace {

constexpr std::size_t kMaxViolations = 20;
constexpr double kSlack = 1e-9;  // rounding error [N]

bool zero(const Received& request) { return request.counts == std::array<int, 3>{}; }

std::span<const Mat3> posesOf(const Knowledge& knowledge) { return {knowledge.rates.data(), knowledge.poses}; }

}  // namespace

Vec3 forceOf(const std::array<int, 3>& counts, const Mat3& rates) {
  return rates.transpose() * (kTorquePerCount * Vec3(counts[0], counts[1], counts[2]));
}

double roundingOf(const Mat3& rates) { return 0.5 * std::abs(kTorquePerCount) * rates.rowwise().norm().sum(); }

void ForceWatch::judge(bool broken, const char* what, const Received& request) {
  if (!broken || violations_.size() >= kMaxViolations) return;
  char line[200];
  std::snprintf(line, sizeof line, "%s at %.6f s: (%d, %d, %d) counts", what, request.time, request.counts[0],
                request.counts[1], request.counts[2]);
  violations_.emplace_back(line);
}

void ForceWatch::see(const Received& request, const Knowledge& knowledge) {
  const int max = std::ranges::max(request.counts, {}, [](int c) { return std::abs(c); });
  judge(std::abs(max) > kMaxCounts, "more counts than a motor has", request);
  judge(!zero(request) && !knowledge.lost_homed && knowledge.homed_replies < kHomedReplies,
        "force before all references were reported", request);
  // the host computes from one of the poses it has read; use the most favourable one
  double min = zero(request) ? 0 : std::numeric_limits<double>::infinity();
  for (const Mat3& rates : posesOf(knowledge)) {
    min = std::min(min, forceOf(request.counts, rates).norm() - roundingOf(rates));
  }
  judge(!zero(request) && min > limits_.force + kSlack, "more force than the limit", request);
  if (std::isfinite(min)) largest_force_ = std::max(largest_force_, min);
  judgeRelease(request, knowledge, min);
  if (last_.time >= 0) judgeStep(request, knowledge);
  last_ = request;
  last_knowledge_ = knowledge;
}

void ForceWatch::judgeStep(const Received& request, const Knowledge& knowledge) {
  if (zero(request) && zero(last_)) return;
  double step = std::numeric_limits<double>::infinity();
  for (const Mat3& now : posesOf(knowledge)) {
    for (const Mat3& before : posesOf(last_knowledge_)) {
      const double rounding = (zero(request) ? 0 : roundingOf(now)) + (zero(last_) ? 0 : roundingOf(before));
      step = std::min(step, (forceOf(request.counts, now) - forceOf(last_.counts, before)).norm() - rounding);
    }
  }
  if (std::isfinite(step)) largest_step_ = std::max(largest_step_, step);
  const double elapsed = request.time - last_.time + limits_.jitter;
  judge(std::isfinite(step) && step > limits_.force_rate * elapsed + kSlack, "force changed faster than the slew limit",
        request);
}

void ForceWatch::judgeRelease(const Received& request, const Knowledge& knowledge, double min) {
  if (!knowledge.lost_homed) {
    released_from_ = -1;
    return;
  }
  if (released_from_ < 0) {
    // no request since the host knows of the loss; the release starts at its last force
    released_from_ = last_.time < 0 || zero(last_) ? 0 : std::numeric_limits<double>::infinity();
    for (const Mat3& rates : posesOf(last_knowledge_)) {
      released_from_ = std::min(released_from_, forceOf(last_.counts, rates).norm() + roundingOf(rates));
    }
  }
  if (zero(request)) {
    released_from_ = 0;
    return;
  }
  const double fallen = limits_.force_rate * (request.time - knowledge.lost_at - limits_.jitter);
  judge(!(min <= released_from_ - std::max(0.0, fallen) + kSlack), "force after a reference was lost", request);
}

}  // namespace presa::falcon_model
