#pragma once
#include <array>
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
/// query. A patch serves as long as what a finger needs lies within it: then nothing is looked for and nothing is copied.
/// Bodies with a primitive as haptic geometry are not served: the haptic loop handles those in closed form.
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
    std::vector<Vec3> placed;  ///< vertices in body coordinates; empty: those of the mesh itself
    const std::vector<Vec3>& vertices() const noexcept { return placed.empty() ? index->mesh().vertices : placed; }
  };
  /// Sphere around a finger, in body coordinates, within which its patch must be complete, and is.
  struct Ball {
    Vec3 center_B = Vec3::Zero();
    double radius = -1;  ///< [m]; negative: none
    bool full = false;   ///< the capacity of a patch set the radius
    bool holds(const Ball& other) const noexcept { return (other.center_B - center_B).norm() + other.radius <= radius; }
  };
  /// What is near one finger on one body, before the finger's capacity is shared out.
  struct Candidate {
    const MeshBody* mesh_body = nullptr;
    Ball needed;
    Gathered gathered;
    double nearest = 0;  ///< distance of its nearest triangle [m]
    std::vector<NearTriangle> triangles;
  };

  Pose poseOf(std::int32_t body, double time) const noexcept;
  /// Centre of the query: the proxy in body coordinates, the HIP when there is none.
  Vec3 centerOf(std::size_t finger, std::int32_t body, const Pose& X_WB) const noexcept;
  double reachOf(std::size_t finger, std::int32_t body, const Pose& X_WB, const Vec3& center_B,
                 const Tick& tick) const noexcept;
  /// What finger must find on a mesh body; no radius when the body is out of its reach.
  Ball neededOn(const MeshBody& mesh_body, std::size_t finger, const Tick& tick) const noexcept;
  /// The finger's last patch still has all that it needs.
  bool lastPatchServes(std::size_t finger, const Tick& tick) const noexcept;
  void gatherAround(std::size_t finger, const Tick& tick, StageWatch& watch) noexcept;
  /// Keeps in mind which balls the finger's new patch is complete in; counts the patches that were cut short.
  std::uint64_t remember(std::size_t finger) noexcept;
  /// Keeps the nearest bodies; returns how many were left out.
  std::size_t keepNearestBodies() noexcept;
  /// Keeps the nearest triangles of all candidates together when they are too many for one finger.
  void keepNearestTriangles() noexcept;
  static void write(Candidate& candidate, FingerPatch& patch) noexcept;

  std::shared_ptr<const World> world_;
  std::size_t capacity_;  ///< triangles of one finger's patch
  std::vector<MeshBody> mesh_bodies_;
  double dynamics_period_;
  std::array<std::vector<Ball>, kMaxFingers> known_;  ///< of each mesh body
  std::uint64_t serial_ = 0;
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
