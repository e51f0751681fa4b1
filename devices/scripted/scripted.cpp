#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "devices/scripted/finger_plant.h"
#include "devices/scripted/motion.h"
#include "framework/plan/plugin.h"
#include "framework/schedule/rates.h"

namespace presa {
namespace {

// A hand corrects slowly: these are rates of its integrators, far below the contact's dynamics.
constexpr double kGripTime = 0.1;      // [s] to correct a grip force that is not as wanted
constexpr double kPositionRate = 3;    // [1/s] to carry a load without sagging
constexpr double kMaxCorrection = 20;  // [N] either may reach

/// A simulated fingertip that follows a motion through its own mass, damping and stiffness: what it touches
/// pushes it back. Across the grip it keeps its place; along the grip it keeps its force.
class ScriptedFinger final : public Device {
 public:
  ScriptedFinger(std::unique_ptr<Motion> motion, const FingerImpedance& impedance, double period,
                 std::vector<std::string> notes)
      : motion_(std::move(motion)), impedance_(impedance), plant_(impedance, period), notes_(std::move(notes)) {
    plant_.reset(motion_->at(0).p_WT);
  }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    return {plant_.position(), plant_.velocity(), motion_->at(tick.time).phase, true};
  }

  void write(const Vec3& f_H_W, const Tick& tick) noexcept override {
    advance(tick);
    force_ = f_H_W;
  }

  std::vector<std::string> phases() const override { return motion_->phase_names; }
  std::vector<double> phaseTimes() const override { return motion_->phase_times; }
  std::string model() const override { return "scripted fingers: no person"; }
  double damping() const override { return impedance_.damping; }
  std::vector<std::string> notes() const override { return notes_; }

 private:
  /// Up to a tick under the held force; after a stall that is more than one period.
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) live(at_.time, tick.period);
    at_ = tick;
  }

  void live(double time, double period) noexcept {
    // the target in the middle of the coming period: second-order accurate under zero-order hold
    const MotionTarget target = motion_->at(time + period / 2);
    const Vec3& inward = target.inward_W;
    const bool gripping = inward.squaredNorm() > 0;

    Vec3 lag = target.p_WT - plant_.position();
    if (gripping) {
      lag -= lag.dot(inward) * inward;
      const double felt = -force_.dot(inward);
      if (felt > 0.05 * target.grip) grip_ += (target.grip - felt) * period / kGripTime;
    } else {
      grip_ -= grip_ * period / kGripTime;
    }
    grip_ = std::clamp(grip_, -kMaxCorrection, kMaxCorrection);
    carry_ += impedance_.stiffness * kPositionRate * period * lag;
    if (const double norm = carry_.norm(); norm > kMaxCorrection) carry_ *= kMaxCorrection / norm;

    Vec3 force = force_ + target.force_W + carry_;
    if (gripping) force += (target.grip + grip_) * inward;
    plant_.step(target.p_WT, target.v_WT, force);
  }

  std::unique_ptr<Motion> motion_;
  FingerImpedance impedance_;
  FingerPlant plant_;
  std::vector<std::string> notes_;
  Tick at_;                    // where the plant is
  Vec3 force_ = Vec3::Zero();  // [N] held by the device since the last write
  double grip_ = 0;            // [N] beyond the wanted grip
  Vec3 carry_ = Vec3::Zero();  // [N] that carries the load
};

using Settings = std::map<std::string, DeviceBinding::Setting>;

double positive(const Settings& settings, const std::string& key, double fallback, Diagnostics& diagnostics) {
  const auto found = settings.find(key);
  if (found == settings.end()) return fallback;
  const std::string& text = found->second.value;
  double value = 0;
  const auto [rest, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc{} || rest != text.data() + text.size() || !(value > 0) || !std::isfinite(value)) {
    diagnostics.error(403, found->second.where, key + " must be a positive number, found '" + text + "'");
    return fallback;
  }
  return value;
}

double sideOf(const DeviceBinding& binding, Diagnostics& diagnostics) {
  if (const auto side = binding.settings.find("side"); side != binding.settings.end()) {
    if (side->second.value == "-1") return -1;
    if (side->second.value == "1" || side->second.value == "+1") return 1;
    diagnostics.error(404, side->second.where, "side must be -1 or 1, found '" + side->second.value + "'",
                      "-1 is the end of the grasp axis that it points away from (the thumb's)");
  }
  return binding.role == "thumb" ? -1 : 1;
}

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  static const std::vector<std::string> kKeys{"motion", "side", "mass", "stiffness", "damping"};
  const std::size_t before = diagnostics.errorCount();
  for (const auto& [key, setting] : binding.settings) {
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
      diagnostics.error(401, setting.where, "driver 'scripted' has no setting '" + key + "'" + didYouMean(key, kKeys),
                        "settings: motion (file), side, mass, stiffness, damping");
    }
  }
  const auto file = binding.settings.find("motion");
  if (file == binding.settings.end()) {
    diagnostics.error(402, binding.where, "role '" + binding.role + "': driver 'scripted' needs the setting 'motion'",
                      "add <set key=\"motion\" value=\"FILE.xml\"/> (phases) or FILE.csv (keyframes)");
    return nullptr;
  }
  MotionContext context{binding.role, sideOf(binding, diagnostics), 0};
  for (const DeviceRole& role : world.scene.devices) {
    if (role.role == binding.role) context.fingertip_radius = role.fingertip_radius;
  }
  const bool keyframes = file->second.value.ends_with(".csv");
  auto motion = keyframes ? readKeyframeMotion(file->second.value, context, diagnostics)
                          : readPhasedMotion(file->second.value, context, diagnostics);
  FingerImpedance impedance = motion ? motion->impedance() : FingerImpedance{};
  impedance.mass = positive(binding.settings, "mass", impedance.mass, diagnostics);
  impedance.stiffness = positive(binding.settings, "stiffness", impedance.stiffness, diagnostics);
  impedance.damping = positive(binding.settings, "damping", impedance.damping, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;

  double stiffest = 0;
  for (const Body& body : world.scene.bodies) {
    if (body.haptic) stiffest = std::max(stiffest, world.scene.materialOf(body).stiffness);
  }
  const RateTable rates(world.scene.rates);
  const double period = rates.period(RateGroup::kHaptic), dynamics_period = rates.period(RateGroup::kDynamics);
  const bool automatic = !(impedance.damping > 0);
  if (automatic) impedance.damping = automaticDamping(impedance, stiffest, period, dynamics_period);
  const double bound = std::max(wallDampingBound(stiffest, period),
                                heldObjectDampingBound(impedance, stiffest, period, dynamics_period));
  std::array<char, 240> text;
  std::snprintf(text.data(), text.size(),
                "%s: finger damping %.3g N s/m%s; contacts of %.3g N/mm at %.0f and %.0f Hz ask for %.3g",
                binding.role.c_str(), impedance.damping, automatic ? " (auto)" : "", stiffest * 1e-3, 1 / period,
                1 / dynamics_period, bound);
  std::vector<std::string> notes{text.data()};
  if (impedance.damping < bound) notes.back() += ": UNSTABLE, raise damping or lower stiffness";
  return std::make_unique<ScriptedFinger>(std::move(motion), impedance, period, std::move(notes));
}

const DevicePlugin kPlugin{.name = "scripted",
                           .summary = "simulated fingertip that follows a motion file through a finger's impedance",
                           .create = create};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
