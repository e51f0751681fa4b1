#pragma once
#include <optional>
#include <vector>

#include "framework/core/state/finger_neighbourhood.h"
#include "framework/core/state/object_state.h"
#include "framework/haptics/surroundings.h"
#include "framework/scene/world.h"

namespace presa {

/// The primitive of a geometry, with its pose in the body as X_AG; none for a mesh. Thread: any.
std::optional<Primitive> primitiveOf(const Geometry& geometry);

/// All touchable bodies at their current poses. The pose of a moving body is computed on demand, so that in a scene of
/// thousands a tick costs only as much as the bodies near its fingers. Thread: haptic; nonblocking except for
/// construction.
class Touchables {
 public:
  explicit Touchables(const World& world);  ///< keeps references to the meshes: `world` must outlive it

  /// Radius of the sphere that stands in for a point-shaped fingertip [m]: far above the rounding errors of the largest
  /// body, far below any perceptible size of the smallest. Depth and contact point are reported for the point.
  double lift() const noexcept { return std::max(1e-6 * largest_, 1e-5 * smallest_); }
  std::size_t meshCount() const noexcept { return mesh_count_; }  ///< touchable bodies that are meshes
  /// Whether `body` is the index of a touchable body.
  bool has(std::int32_t body) const noexcept {
    return static_cast<std::size_t>(body) < touchable_of_.size() && touchable_of_[static_cast<std::size_t>(body)] >= 0;
  }

  /// Sets the poses of a tick: interpolated at `time`, or held at the end of the dynamics step. Before the first call
  /// bodies have their start poses.
  void interpolate(const ObjectState& objects, double time) noexcept;
  void hold(const ObjectState& objects) noexcept;  ///< until the next call, at ObjectState::time_end

  /// Pose X_WB in this tick; identity for kNoBody.
  Pose frameOf(std::int32_t body) const noexcept { return body == kNoBody ? Pose{} : placed(body); }
  /// Velocity of the material point of the body at p_W [m/s].
  Vec3 velocityAt(std::int32_t body, const Vec3& p_W) const noexcept;
  /// Fills `near`, in the coordinates of the body `frame`, with everything that a fingertip can meet while its centre
  /// stays within `reach` of the HIP, which moved by `moved` since the last tick. When `neighbourhood` is null or does
  /// not cover this, all bodies are examined. Returns the distance by which a surface may have approached the HIP in a
  /// tick of `period` [m].
  double surround(Surroundings& near, std::int32_t frame, const Vec3& p_WH, double reach, double moved, double period,
                  const FingerNeighbourhood* neighbourhood) const noexcept;

 private:
  struct Touchable {
    std::int32_t body = kNoBody;
    ConvexPiece primitive;           ///< X_AG holds X_BG
    const MeshTree* tree = nullptr;  ///< null: a primitive
    Pose X_BG;
    Vec3 center_B = Vec3::Zero();  ///< centre of the bounding sphere
    double radius = 0;             ///< [m]
  };
  static Touchable touchableOf(const World& world, std::size_t body);
  const Pose& placed(std::int32_t body) const noexcept;
  /// Query of one finger in one tick.
  struct Query {
    Surroundings& near;
    std::int32_t frame;
    const Pose& X_WA;
    const Vec3 &p_WH, &p_AH;
    double reach, moved, period;
  };
  /// Adds the body if it is within reach; returns the distance by which it may have approached in a tick [m].
  double meet(const Touchable& touchable, const Query& query, const NearBody* near) const noexcept;

  std::vector<Touchable> touchables_;
  std::vector<std::int32_t> touchable_of_;  // by body; -1: not touchable
  std::vector<char> moves_;                 // by body
  double largest_ = 0, smallest_ = 0;       // radii of the bounding spheres [m]
  std::size_t mesh_count_ = 0;
  const ObjectState* objects_ = nullptr;  // object state of this tick
  double time_ = 0;
  bool at_end_ = false;
  // pose cache, filled on demand; single thread
  mutable std::vector<Pose> X_WB_;
  mutable std::vector<std::uint64_t> placed_in_;  // tick
  std::uint64_t tick_ = 0;
};

}  // namespace presa
