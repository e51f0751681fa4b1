#pragma once
#include <functional>

#include "tests/modules/haptics_proxy/surface/support/finger_rig.h"
#include "tests/modules/haptics_proxy/surface/support/mesh_oracle.h"
#include "tests/modules/haptics_proxy/surface/support/wanderer.h"

namespace presa::test {

/// What went wrong while a finger wandered; all zero: nothing.
struct WanderFaults {
  std::int64_t ticks = 0;
  std::int64_t touching = 0;                         ///< of these
  std::int64_t inside = 0;                           ///< ticks with the fingertip's centre inside of the closed mesh
  double first_inside = -1;                          ///< [s]
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();  ///< the proxy's way in that tick
  std::int64_t overlapping = 0;  ///< ticks in which the fingertip stood in the surface by more than 1 % of its radius
  double deepest = 0;            ///< overlap [m]
  std::int64_t too_strong = 0;   ///< ticks with more force than k |p_WP - p_WH|
  std::int64_t not_finite = 0;   ///< ticks
  std::uint32_t popped = 0, lost = 0;  ///< as the renderer counted
  /// By how much the distance from proxy to HIP grew in a tick, beyond the HIP's way in that tick [m]. Without friction
  /// the proxy itself only ever comes nearer: more is a jump that nothing explains.
  double worst_growth = 0;
  bool any() const { return inside + overlapping + too_strong + not_finite + popped + lost > 0; }
};

/// One wandering finger over one mesh, judged tick by tick.
class WanderRun {
 public:
  /// `closed`: whether there is an inside to be judged.
  WanderRun(std::shared_ptr<const TriMesh> mesh, const MeshOracle& oracle, const Touch& touch, std::uint64_t seed,
            bool stiff, bool closed);
  /// Goes on for so many ticks; `look` may see each.
  void run(int ticks, const std::function<void(const FingerContact&)>& look = {});
  const WanderFaults& faults() const { return faults_; }
  double time() const { return rig_.time(); }

 private:
  std::shared_ptr<const TriMesh> mesh_;
  const MeshOracle& oracle_;
  FingerRig rig_;
  Wanderer wanderer_;
  InsideWatch watch_;
  bool closed_;
  WanderFaults faults_;
  Vec3 force_ = Vec3::Zero();
  double depth_ = 0;
};

}  // namespace presa::test
