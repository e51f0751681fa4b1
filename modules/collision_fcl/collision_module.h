#pragma once
#include <memory>
#include <vector>

#include "framework/graph/port.h"
#include "framework/graph/stage_watch.h"
#include "framework/scene/world.h"
#include "framework/state/contact_exchange.h"
#include "framework/state/contact_patch.h"
#include "framework/state/device_state.h"
#include "framework/state/object_state.h"
#include "modules/collision_fcl/triangle_index.h"

namespace presa {

/// Collision query: around every finger, the triangles of each mesh body that the finger can reach before the next
/// query. Bodies with a primitive as haptic geometry are not served: the haptic loop handles those in closed form.
/// In: contact_exchange, device_state, object_state (optional; absent: bodies stay at their start pose).
/// Out: contact_patches. Thread: collision.
class CollisionModule final : public Module, public WatchedStages {
 public:
  explicit CollisionModule(std::shared_ptr<const World> world);

  void step(const Tick& tick) noexcept override;
  void stepWatched(const Tick& tick, StageWatch& watch) noexcept override;
  std::vector<std::string> stages() const override;
  std::vector<std::string> stageFunctions() const override;

  In<ContactExchange> contact_exchange{*this, "contact_exchange"};
  In<DeviceState> device_state{*this, "device_state"};
  In<ObjectState> object_state{*this, "object_state", In<ObjectState>::Optional{}};
  Out<ContactPatches> contact_patches{*this, "contact_patches"};

 private:
  /// A body whose haptic geometry is a mesh.
  struct MeshBody {
    std::int32_t body;
    Pose X_BG;
    std::shared_ptr<const TriangleIndex> index;
  };
  /// What is near one finger on one body, before the finger's capacity is shared out.
  struct Candidate {
    const MeshBody* mesh_body = nullptr;
    Vec3 center_B = Vec3::Zero();
    Gathered gathered;
    double nearest = 0;  ///< distance of its nearest triangle [m]
    std::vector<NearTriangle> triangles;
  };

  /// Where to look for triangles.
  struct Query {
    Vec3 center_B, center_G;
    double radius = 0;
  };

  Pose poseOf(std::int32_t body, double time) const noexcept;
  /// Centre of the query: the proxy in body coordinates, the HIP when there is none.
  Vec3 centerOf(std::size_t finger, std::int32_t body, const Pose& X_WB) const noexcept;
  double reachOf(std::size_t finger, std::int32_t body, const Pose& X_WB, const Vec3& center_B,
                 const Tick& tick) const noexcept;
  void gatherAround(std::size_t finger, const Tick& tick, StageWatch& watch) noexcept;
  /// The finger's query in the mesh's coordinates; false when the body is out of reach.
  bool place(std::size_t finger, const MeshBody& mesh_body, const Tick& tick, Query& query) const noexcept;
  /// Keeps the nearest bodies; returns how many were left out.
  std::size_t keepNearestBodies() noexcept;
  /// Keeps the nearest triangles of all candidates together when they are too many for one finger.
  void keepNearestTriangles() noexcept;
  static void write(Candidate& candidate, FingerPatch& patch) noexcept;

  std::shared_ptr<const World> world_;
  std::size_t capacity_;  ///< triangles of one finger's patch
  std::vector<MeshBody> mesh_bodies_;
  double dynamics_period_;
  // Reused every step so that a step allocates nothing once they have grown.
  std::vector<Candidate> candidates_;
  std::size_t candidate_count_ = 0;
  struct Contender {
    NearTriangle triangle;
    std::size_t candidate;
  };
  std::vector<Contender> contenders_;
};

}  // namespace presa
