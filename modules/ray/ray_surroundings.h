#pragma once
#include <memory>
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/contact_lcp.h"
#include "framework/haptics/convex_pairs.h"
#include "framework/scene/world.h"
#include "modules/ray/segment_front.h"

namespace presa {

/// A ray: the axis of a capsule, and its radius.
struct Ray {
  Segment axis_T;     ///< in the frame T of the handle
  double radius = 0;  ///< [m], > 0
  /// The axis of a tool at X_WT.
  Segment axisAt(const Pose& X_WT) const noexcept { return {X_WT * axis_T.a, X_WT * axis_T.b}; }
};

/// The touchable bodies of a world, meshes as they are, numbered as solids: first all other shapes, then the meshes.
struct RayBodies {
  /// A mesh.
  struct Mesh {
    std::int32_t body = kNoBody;           ///< index into Scene::bodies
    std::shared_ptr<const MeshTree> tree;  ///< in G
    Pose X_BG;                             ///< of the mesh in its body
  };
  explicit RayBodies(const World& world);
  std::vector<std::int32_t> bodies() const;  ///< index into Scene::bodies, by solid
  std::vector<ConvexSolid> shapes;           ///< boxes, spheres, cylinders and capsules, exactly
  std::vector<Mesh> meshes;                  ///< solid number shapes.size() and on
};

/// The places at which bodies may hold a ray, found anew at every pose that a step tries. Memory is fixed after
/// construction. Thread: haptic; nonblocking except for construction.
class RaySurroundings {
 public:
  static constexpr std::size_t kMaxMeshes = 16;  ///< meshes near a ray at once
  static constexpr std::size_t kPlaces = 48;     ///< triangles that may hold it in a step

  /// All must outlive it. `tool` is the same capsule as `ray`.
  RaySurroundings(const Ray& ray, const ConvexSolid& tool, const RayBodies& bodies);

  /// Poses of the bodies in this tick, by solid.
  void place(const Touchables& touchables, const std::vector<Pose>& X_WB) noexcept;
  /// Begins a step at X_WT, of which no point of the ray will move farther than `reach` [m]. False: nothing is near.
  bool begin(const Pose& X_WT, double reach) noexcept;
  /// Fills `points` with the places at which bodies hold the ray at X_WT or nearly do; `p` in the orientation that the step
  /// begins with, `gap` at X_WT.
  void look(const Pose& X_WT, BoundedList<PressedPoint>& points) noexcept;
  /// Distance of the axis from all bodies at the last look(), as far as radius and `reach` together [m].
  double clearance() const noexcept { return clearance_; }
  /// Ends a step at the pose of the last look(): places that it does not touch there are forgotten.
  void keep() noexcept;
  void forget() noexcept;  ///< the tool has been elsewhere
  /// False: something near found no room since begin().
  bool whole() const noexcept { return whole_; }

 private:
  /// A mesh near the ray.
  struct Near {
    SegmentFront front;
    std::size_t mesh = 0;    // index into RayBodies::meshes
    std::uint64_t tick = 0;  // in which it was near last
    Pose X_WG;               // in this tick
    bool used = false;       // it holds a mesh
  };
  /// A triangle that holds the ray, or did at an earlier look of this step.
  struct Place {
    std::size_t near = 0;  // index into near_
    std::int32_t ref = 0;  // item of its front
    SegmentNearest at;     // at the last look
  };
  Near* nearOf(std::size_t mesh) noexcept;
  void lookAtShapes(const Pose& X_WT, BoundedList<PressedPoint>& points) noexcept;
  void lookAtMesh(std::size_t slot, const Pose& X_WT, BoundedList<PressedPoint>& points) noexcept;
  void add(const SegmentNearest& at, const Near& near, BoundedList<PressedPoint>& points) noexcept;

  const Ray& ray_;
  const RayBodies& bodies_;
  ConvexPairs pairs_;
  const std::vector<Pose>* X_WB_ = nullptr;
  std::vector<std::unique_ptr<Near>> near_;  // all slots
  std::vector<std::size_t> now_;             // slots of this step
  std::size_t now_count_ = 0;
  BoundedList<Place> places_;
  Quat q_begin_ = Quat::Identity();
  double reach_ = 0, clearance_ = 0;
  std::uint64_t tick_ = 0;
  bool whole_ = true;
};

}  // namespace presa
