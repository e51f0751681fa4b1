#include "tests/modules/haptics_proxy/surface/support/wander_run.h"

namespace presa::test {

WanderRun::WanderRun(std::shared_ptr<const TriMesh> mesh, const MeshOracle& oracle, const Touch& touch,
                     std::uint64_t seed, bool stiff, bool closed)
    : mesh_(std::move(mesh)),
      oracle_(oracle),
      rig_(mesh_, touch),
      wanderer_(*mesh_, seed, stiff),
      watch_(oracle_),
      closed_(closed) {}

void WanderRun::run(int ticks, const std::function<void(const FingerContact&)>& look) {
  const Touch& touch = rig_.touch();
  for (int i = 0; i < ticks; ++i) {
    const double time = rig_.time();
    const Vec3 before_H = wanderer_.position(), p_WH = wanderer_.next(force_);
    const FingerContact& felt = rig_.tick(p_WH);
    ++faults_.ticks;
    if (!felt.f_H_W.allFinite() || !felt.p_WP.allFinite()) {
      ++faults_.not_finite;
      force_ = Vec3::Zero();
      continue;
    }
    if (felt.mode != ContactMode::kNone) ++faults_.touching;
    const double depth = (felt.p_WP - p_WH).norm(), force = felt.f_H_W.norm();
    // tolerance: rounding of coordinates of 0.1 m
    if (force > touch.stiffness * (depth * (1 + 1e-9) + 1e-12)) ++faults_.too_strong;
    faults_.worst_growth = std::max(faults_.worst_growth, depth - depth_ - (p_WH - before_H).norm());
    depth_ = depth;
    if (closed_ && watch_.update(felt.p_WP)) {
      ++faults_.inside;
      if (faults_.first_inside < 0) {
        faults_.first_inside = time;
        faults_.after = felt.p_WP;
      }
    }
    if (faults_.first_inside < 0) faults_.before = felt.p_WP;
    const double overlap = touch.radius - oracle_.nearest(felt.p_WP, touch.radius).distance;
    faults_.deepest = std::max(faults_.deepest, overlap);
    if (overlap > 0.01 * touch.radius) ++faults_.overlapping;
    force_ = felt.f_H_W;
    if (look) look(felt);
  }
  faults_.popped = rig_.all().pop_through;
  faults_.lost = rig_.all().coverage_lost;
}

}  // namespace presa::test
