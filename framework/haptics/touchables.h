#pragma once
#include <vector>

#include "framework/core/state/contact_patch.h"
#include "framework/core/state/object_state.h"
#include "framework/haptics/surroundings.h"
#include "framework/scene/world.h"

namespace presa {

/// Every body that a finger can touch, where it is now. A moving body is placed once it is asked for: a scene of thousands
/// costs a tick what is near its fingers. Thread: haptic; nonblocking but for construction.
class Touchables {
 public:
  explicit Touchables(const World& world);

  /// A true point is moved as a sphere of this radius [m]: far above the rounding of the largest body, far below what is felt of
  /// the smallest. Its depth and its contact point are those of the point.
  double lift() const noexcept { return std::max(1e-6 * largest_, 1e-5 * smallest_); }
  std::size_t meshCount() const noexcept { return mesh_count_; }

  /// How moving bodies are placed in a tick; before the first call they are where the scene puts them.
  void interpolate(const ObjectState& objects, double time) noexcept;
  void hold(const ObjectState& objects) noexcept;

  Pose frameOf(std::int32_t body) const noexcept { return body == kNoBody ? Pose{} : placed(body); }
  /// Velocity of the body's point that is at p_W now [m/s].
  Vec3 velocityAt(std::int32_t body, const Vec3& p_W) const noexcept;
  /// Puts into `near`, in the coordinates of the body `frame`, what a fingertip can meet while its centre stays within `reach` of the
  /// HIP, which has `moved` since the tick before.
  /// `patch` null or of no use here: every body is looked at. Returns how much nearer a surface may have come to the HIP in a
  /// tick of `period` [m].
  double surround(Surroundings& near, std::int32_t frame, const Vec3& p_WH, double reach, double moved, double period,
                  const FingerPatch* patch) const noexcept;

 private:
  struct Touchable {
    std::int32_t body = kNoBody;
    ConvexPiece primitive;           ///< X_AG holds X_BG
    const MeshTree* tree = nullptr;  ///< null: a primitive
    Pose X_BG;
    Vec3 center_B = Vec3::Zero();  ///< of its bounding sphere
    double radius = 0;             ///< [m]
  };
  static Touchable touchableOf(const World& world, std::size_t body);
  const Pose& placed(std::int32_t body) const noexcept;
  /// What one finger looks for in one tick.
  struct Look {
    Surroundings& near;
    std::int32_t frame;
    Pose X_AW;
    Vec3 p_WH;
    double reach, moved, period;
  };
  /// Adds it if it is in reach; returns how much nearer it may have come in a tick [m].
  double meet(const Touchable& touchable, const Look& look, const NearBody* near) const noexcept;

  std::vector<Touchable> touchables_;
  std::vector<std::int32_t> touchable_of_;  // by body; -1: it cannot be touched
  std::vector<char> moves_;                 // by body
  double largest_ = 0, smallest_ = 0;       // radius of a body's bounding sphere [m]
  std::size_t mesh_count_ = 0;
  const ObjectState* objects_ = nullptr;  // of this tick
  double time_ = 0;
  bool at_end_ = false;
  // a cache, filled as bodies are asked for: one thread
  mutable std::vector<Pose> X_WB_;
  mutable std::vector<std::uint64_t> placed_in_;  // tick
  std::uint64_t tick_ = 0;
};

}  // namespace presa
