// Torsional friction of a soft fingertip on an oriented tool: a rotational spring about the contact normal, tied to the
// body, that slips as the tangential spring does. A uniformly pressed disc of radius a bears (2/3) mu F_n a, so the
// material's torsional radius is r = (2/3) a. A tangential stiffness k spread evenly over the disc turns with k a^2 / 2 =
// (9/8) k r^2. Sliding along the surface does not lower the torque here; on a real disc it does.
#include <algorithm>
#include <cmath>
#include <vector>

#include "modules/haptics_proxy/finger_stage.h"

namespace presa {
namespace {

class Torsion final : public FingerStage {
 public:
  explicit Torsion(const SurfacesInForce& surfaces) : surfaces_(surfaces), turns_(surfaces.scene.devices.size()) {}

  void apply(FingerTick& tick) noexcept override {
    FingerContact& out = tick.out;
    Turn& turn = turns_[tick.index];
    const double radius = out.body == kNoBody ? 0 : surfaces_.of(out.body).torsional_radius;
    if (!tick.input.oriented || !(radius > 0)) {
      turn.holds = false;
      return;
    }
    turnTo(tick.X_WA.q.conjugate() * tick.input.q_WT, tick.contact.nhat, turn);
    out.twist_stiffness = 9.0 / 8 * out.stiffness * radius * radius;
    const double arm = out.twist_stiffness > 0 ? radius * out.stiffness * out.depth / out.twist_stiffness : 0;
    const double sliding = out.friction_dynamic * arm;
    turn.slips = std::abs(turn.twist) > (turn.slips ? sliding : out.friction_static * arm);
    if (turn.slips) turn.twist = std::clamp(turn.twist, -sliding, sliding);
    out.twist = turn.twist;
    out.twist_slips = turn.slips;
    out.spin = tick.input.w_WT.dot(out.nhat_W);
    out.t_H_W = -out.twist_stiffness * out.twist * out.nhat_W;
  }

  void changeFrame(std::size_t finger, const Pose& X_BA) noexcept override {
    turns_[finger].q_AT = X_BA.q * turns_[finger].q_AT;
  }

  std::string what() const override { return "torsional friction of oriented tools about the normal"; }

 private:
  /// From tick to tick, in the working frame A: the tool's orientation and its turn that the contact holds.
  struct Turn {
    bool holds = false, slips = false;
    Quat q_AT = Quat::Identity();
    double twist = 0;  // [rad]
  };

  static void turnTo(const Quat& q_AT, const Vec3& nhat, Turn& turn) noexcept {
    if (turn.holds) {
      Quat step = q_AT * turn.q_AT.conjugate();
      if (step.w() < 0) step.coeffs() *= -1;
      turn.twist += 2 * std::atan2(step.vec().dot(nhat), step.w());
    } else {
      turn = {.holds = true};
    }
    turn.q_AT = q_AT;
  }

  const SurfacesInForce surfaces_;
  std::vector<Turn> turns_;  // by finger
};

}  // namespace

std::unique_ptr<FingerStage> makeTorsion(const SurfacesInForce& surfaces) {
  return std::make_unique<Torsion>(surfaces);
}

}  // namespace presa
