#pragma once
#include <span>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/friction_law.h"
#include "framework/haptics/renderer.h"

namespace presa {

/// The law between a finger and a body, with the coefficients in force in this tick.
struct BodyLaw {
  const FrictionLaw* law = nullptr;
  double mu_static = 0, mu_dynamic = 0;
  Quat q_BA = Quat::Identity();
};

/// The friction of a finger in one tick.
class Friction {
 public:
  Friction(double stiffness, double period) : stiffness_(stiffness), period_(period) {}
  virtual BodyLaw of(std::int32_t body) const noexcept = 0;
  double stiffness() const noexcept { return stiffness_; }  ///< of the finger's spring [N/m]
  double period() const noexcept { return period_; }        ///< [s]

 protected:
  ~Friction() = default;

 private:
  double stiffness_, period_;
};

/// Friction between a finger and one of the bodies that hold it, in the working frame A: a spring of its own, which has
/// `share` of the finger's stiffness, from the HIP to an anchor of its own.
struct BodyFriction {
  std::int32_t body = kNoBody;
  double depth = 0;                  ///< times stiffness: normal force of the body [m]
  double share = 1;                  ///< depth / sum over the bodies that hold the finger
  Vec3 anchor = Vec3::Zero();        ///< friction pulls the HIP towards it
  Vec3 displacement = Vec3::Zero();  ///< tangential, if the anchor stays [m]
  bool fresh = true;                 ///< no tick with this body yet
  bool slipping = false;
  FrictionState law{};  ///< the law's own
  FrictionAnswer answer{};
};

/// What friction keeps of a finger from tick to tick, in the working frame A. Without a contact it has no meaning.
struct Held {
  /// `max_bodies`: of those that can hold the finger at the same time.
  explicit Held(std::size_t max_bodies = std::tuple_size_v<decltype(ActiveSet::member)>) : bodies(max_bodies) {}
  BoundedList<BodyFriction> bodies;  ///< that hold the finger
  double depth = 0;                  ///< sum over the bodies [m]
  Vec3 anchor = Vec3::Zero();        ///< mean of theirs, weighted by share; its image on the surface is the proxy
  Vec3 g = Vec3::Zero();             ///< HIP of the last tick
  bool fresh = true;                 ///< friction begins anew in the next tick
};

/// Takes from the projection `along` the directions that leave the plane of normal nhat, so that the rest lies in all
/// planes.
inline void keepAlong(const Vec3& nhat, Mat3& along) noexcept {
  constexpr double kParallel = 0.05;  // sine of planes that count as one, squared
  const Vec3 rest = along * nhat;
  if (rest.squaredNorm() > kParallel) along -= rest * rest.transpose() / rest.squaredNorm();
}

/// Applies friction to a sliding `contact`: a sticking proxy stays at its last position or at the first touch, a
/// slipping one goes where the tangential forces of the laws put it. `own`: contacts of the renderer, or empty. Writes
/// the answers to `held`. Returns the body whose law broke its contract, or kNoBody.
std::int32_t holdByFriction(ProxyContact& contact, std::span<const RenderedContact> own, const ProxyState& last,
                            Held& held, const Vec3& g, double r, const Friction& friction, const ProxyMover& mover,
                            Surroundings& near) noexcept;

}  // namespace presa
