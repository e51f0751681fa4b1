#pragma once
#include <functional>

#include "tests/modules/haptics_proxy/surface/support/finger_rig.h"
#include "tests/modules/haptics_proxy/surface/support/mesh_oracle.h"
#include "tests/modules/haptics_proxy/surface/support/wanderer.h"

namespace presa::test {

/// Faults during a wandering run; all zero: none.
struct WanderFaults {
  std::int64_t ticks = 0;
  std::int64_t touching = 0;                         ///< ticks in contact
  std::int64_t inside = 0;                           ///< ticks with the fingertip's centre inside the closed mesh
  double first_inside = -1;                          ///< time of the first of these [s]
  Vec3 before = Vec3::Zero(), after = Vec3::Zero();  ///< the proxy's positions around that tick
  std::int64_t overlapping = 0;  ///< ticks in which the fingertip overlapped the surface by more than 1 % of its radius
  double deepest = 0;            ///< largest overlap [m]
  std::int64_t too_strong = 0;   ///< ticks with a force above k |p_WP - p_WH|
  std::int64_t not_finite = 0;   ///< ticks with a force that is not finite
  std::uint32_t popped = 0, lost = 0;  ///< as counted by the renderer
  /// Largest growth of the distance between proxy and HIP in a tick beyond the HIP's own motion [m]. Without friction
  /// the proxy can only reduce that distance, so any growth is an unexplained jump.
  double worst_growth = 0;
  bool any() const { return inside + overlapping + too_strong + not_finite + popped + lost > 0; }
};

/// One wandering finger over one mesh, checked tick by tick.
class WanderRun {
 public:
  /// `closed`: whether the mesh has an inside to check.
  WanderRun(std::shared_ptr<const TriMesh> mesh, const MeshOracle& oracle, const Touch& touch, std::uint64_t seed,
            bool stiff, bool closed);
  /// Continues for `ticks` ticks; `look` receives each contact.
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
