#include "apps/temple/drop.h"

#include <algorithm>

#include "apps/common/atomic_file.h"
#include "experiments/study/study_run.h"

namespace presa::temple {
namespace {

double reachOf(const Block& block) { return radiusOf(block.haptic); }

double between(const Pose& a, const Pose& b, double reach) {
  return (b.p - a.p).norm() + reach * a.q.angularDistance(b.q);
}

}  // namespace

DropResult drop(const Building& building, const std::vector<SceneSpec::Stone>& stones, double duration,
                const std::string& folder) {
  SceneSpec spec;
  spec.name = "drop";
  spec.stones = stones;
  spec.physics_only = true;
  // beside fixed stones islands are small and need no fine steps
  spec.fine_steps = std::ranges::none_of(stones, [](const SceneSpec::Stone& stone) { return stone.fixed; });
  const std::string file = folder + "/drop.xml";
  writeFileAtomically(file, sceneText(building, spec));
  StudySpec study;
  study.scene = file;
  study.duration = duration;
  StudyRun run(study);
  DropResult result;
  for (const SceneSpec::Stone& stone : stones) result.X_WB.push_back(stone.X_WB);
  run.observe([&](const HapticSample& sample) {
    if (sample.objects == nullptr) return;
    result.sound = sample.objects->faults == 0;
    for (std::size_t i = 0; i < stones.size(); ++i) result.X_WB[i] = sample.objects->bodies[i].X_WB_end;
  });
  run.run();
  for (std::size_t i = 0; i < stones.size(); ++i)
    result.moved.push_back(between(stones[i].X_WB, result.X_WB[i], reachOf(building.blocks[stones[i].block])));
  return result;
}

}  // namespace presa::temple
