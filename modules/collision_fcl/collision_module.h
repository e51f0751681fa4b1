#pragma once
#include <map>
#include <memory>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/core/state/contact_exchange.h"
#include "framework/core/state/device_state.h"
#include "framework/core/state/finger_neighbourhood.h"
#include "framework/core/state/object_state.h"
#include "framework/scene/world.h"
#include "modules/collision_fcl/broad_phase.h"
#include "modules/collision_fcl/mesh_index.h"

namespace presa {

/// Collision query: the bodies that every finger can reach before the next query, and for each mesh among them a cut of
/// its hierarchy, from which the haptic tick continues. A neighbourhood is kept as long as it covers the finger's
/// reach; nothing is then searched or copied. A late or too small neighbourhood costs time but no accuracy: the tick
/// then examines all bodies and starts from the roots. In: contact_exchange, device_state, object_state (optional;
/// absent: bodies stay at their start pose). Out: finger_neighbourhoods, sized by the devices. Thread: collision;
/// allocates at construction only.
class CollisionModule final : public Module {
 public:
  explicit CollisionModule(std::shared_ptr<const World> world);

  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override;

  In<ContactExchange> contact_exchange{*this, "contact_exchange"};
  In<DeviceState> device_state{*this, "device_state"};
  In<ObjectState> object_state{*this, "object_state", In<ObjectState>::Optional{}};
  Out<FingerNeighbourhoods> finger_neighbourhoods{*this, "contact_patches"};

 private:
  /// A touchable body with its bounding sphere.
  struct Touchable {
    std::int32_t body = kNoBody;
    const MeshTree* tree = nullptr;  ///< null: a primitive
    MeshIndex* index = nullptr;      ///< null: the tree is its own index
    Pose X_BG;
    Vec3 center_B = Vec3::Zero();
    double radius = 0;  ///< [m]
    bool moves = false;
    Pose X_WB;           ///< pose last placed
    double travel = -1;  ///< distance that it may move until the next neighbourhood, as last placed [m]
  };
  /// Sphere around a finger's HIP that covers all queries of the haptic tick until the next neighbourhood.
  struct Ball {
    Vec3 center_W = Vec3::Zero();
    double radius = 0;  ///< [m]
  };

  double horizon(const Tick& tick) const noexcept;
  /// Updates the broad phase for bodies that have moved.
  void placeBodies(const Tick& tick) noexcept;
  Ball ballOf(std::size_t finger, const Tick& tick) const noexcept;
  /// Whether the finger's last neighbourhood still covers everything it needs.
  bool lastNeighbourhoodServes(std::size_t finger, const Ball& needed) noexcept;
  void makeNeighbourhood(const Ball& needed, const Vec3& last_W, FingerNeighbourhood& neighbourhood) noexcept;
  /// The cut of a mesh for the finger that came from last_W; `near` has centre and radius.
  std::size_t cutOf(const Touchable& touchable, const Vec3& last_W, NearBody& near) noexcept;

  std::shared_ptr<const World> world_;
  std::vector<Touchable> touchables_;
  std::vector<std::int32_t> touchable_of_;  ///< by body; -1: not touchable
  bool any_moves_ = false;
  double dynamics_period_;
  std::uint64_t serial_ = 0;
  BroadPhase broad_phase_;
  std::vector<std::int32_t> found_;                                // reused every step
  std::vector<Vec3> last_W_;                                       ///< by finger: where it was at the last step [m]
  std::map<const MeshTree*, std::unique_ptr<MeshIndex>> indices_;  ///< of the meshes, unless the scene says tree
  FacetSet facets_;                                                ///< what they find; reused
};

}  // namespace presa
