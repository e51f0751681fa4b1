#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

#include "devices/hand/hand_settings.h"
#include "devices/hand/scripted_hand.h"
#include "devices/percro_arm/calibration/calibration_plugin.h"
#include "devices/percro_arm/characterise.h"
#include "devices/percro_arm/drawn_arm.h"
#include "devices/percro_arm/linked_arms.h"
#include "devices/percro_arm/steps.h"
#include "devices/percro_arm/switched_on.h"
#include "devices/percro_arm/thimble.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

const Vec3 kGravity_W{0, 0, -9.81};  // of the room, independent of the scene

/// A modelled arm moved by a scripted hand. Presa sees it through its encoders.
class PercroArm final : public Device {
 public:
  PercroArm(const Pose& X_WD, HandSettings settings, const percro::Parameters& parameters, double period)
      : X_WD_(X_WD),
        hand_(std::move(settings.motion), settings.impedance.stiffness),
        impedance_(settings.impedance),
        lost_at_(settings.lost_at),
        arm_(parameters, X_WD.q.conjugate() * kGravity_W, period),
        notes_(std::move(settings.notes)) {
    arm_.place(X_WD_.inverseTimes(hand_.motion().at(0).p_WT));
    thimble_.place(arm_.state().q);
  }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    const MotionTarget target = hand_.motion().at(tick.time);
    FingerInput input{X_WD_ * arm_.reportedPosition(), X_WD_.q * arm_.reportedVelocity(), target.phase,
                      tick.time < lost_at_};
    input.oriented = true;
    input.q_WT = X_WD_.q * thimble_.orientation();
    input.w_WT = X_WD_.q * thimble_.rate();
    return input;
  }
  bool measuresOrientation() const override { return true; }

  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    advance(tick);
    arm_.command(X_WD_.q.conjugate() * F_H_W.f);
  }

  std::vector<std::string> phases() const override { return hand_.motion().phase_names; }
  std::vector<double> phaseTimes() const override { return hand_.motion().phase_times; }
  std::vector<PhaseIntent> phaseIntents() const override { return hand_.motion().phase_intents; }
  std::string model() const override { return "simulated PERCRO arms, scripted fingers: no device, no person"; }
  std::vector<DeviceFact> facts() const override {
    return {{"motor_heat", "1", arm_.maxHeat(), true}, {"least_force_share", "1", arm_.minShare(), true}};
  }
  double damping() const override { return impedance_.damping; }
  double mass() const override { return impedance_.mass; }  // without the arm's, which changes from place to place
  std::vector<std::string> notes() const override { return notes_; }

 private:
  /// Advances to `tick` under the held torques; after a stall by more than one period.
  void advance(const Tick& tick) noexcept {
    for (; at_.index < tick.index; ++at_.index, at_.time += tick.period) live(at_.time, tick.period);
    at_ = tick;
  }

  void live(double time, double period) noexcept {
    Vec3 push = Vec3::Zero();
    const Vec3 felt = X_WD_.q * arm_.tipForce();
    const MotionTarget target = hand_.live(time, period, X_WD_ * arm_.state().x, felt, push);
    arm_.advance({.mass = impedance_.mass,
                  .stiffness = impedance_.stiffness,
                  .damping = impedance_.damping,
                  .target = X_WD_.inverseTimes(target.p_WT),
                  .target_velocity = X_WD_.q.conjugate() * target.v_WT,
                  .force = X_WD_.q.conjugate() * push});
    thimble_.sample(arm_.state().q, arm_.encoders().joints(), period);
  }

  Pose X_WD_;
  ScriptedHand hand_;
  FingerImpedance impedance_;
  double lost_at_;
  percro::SimulatedArm arm_;
  percro::Thimble thimble_;
  std::vector<std::string> notes_;
  Tick at_;  // time of the arm
};

/// Reads `count` numbers; nullopt with an error otherwise.
std::optional<std::vector<double>> numbersOf(const DeviceBinding& binding, const std::string& key, std::size_t count,
                                             const std::string& example, Diagnostics& diagnostics) {
  const auto found = binding.settings.find(key);
  if (found == binding.settings.end()) {
    diagnostics.error(460, binding.where,
                      "role '" + binding.role + "': driver 'percro_arm' needs the setting '" + key + "'",
                      "where the arm's axes meet, in the world: <set key=\"" + key + "\" value=\"" + example + "\"/>");
    return std::nullopt;
  }
  std::istringstream text(found->second.value);
  std::vector<double> numbers;
  for (double value; text >> value;) numbers.push_back(value);
  double square = 0;
  for (const double value : numbers) square += value * value;
  if (text.eof() && numbers.size() == count && std::isfinite(square) && (count != 4 || square > 0)) return numbers;
  diagnostics.error(461, found->second.where,
                    key + " must be " + std::to_string(count) + " numbers" + (count == 4 ? ", not all 0" : "") +
                        ", found " + quote(found->second.value),
                    "e.g. " + example);
  return std::nullopt;
}

std::optional<Pose> readBase(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const auto p = numbersOf(binding, "pos", 3, "-0.75 0 0.1", diagnostics);
  const auto q = numbersOf(binding, "quat", 4, "0.70711 0.70711 0 0", diagnostics);
  if (!p || !q) return std::nullopt;
  return Pose{{(*p)[0], (*p)[1], (*p)[2]}, Quat((*q)[0], (*q)[1], (*q)[2], (*q)[3]).normalized()};
}

/// Reports a motion that leaves the reach of the arm.
void checkReach(const DeviceBinding& binding, const Pose& X_WD, const Motion& motion, const percro::Geometry& geometry,
                Diagnostics& diagnostics) {
  constexpr double kStep = 0.01;  // [s]
  const double end = motion.phase_times.empty() ? 0 : motion.phase_times.back();
  for (const double t : percro::steps(0, end, static_cast<int>(std::ceil(end / kStep)) + 1)) {
    const percro::Joints q = percro::jointsAt(geometry, X_WD.inverseTimes(motion.at(t).p_WT));
    if (percro::withinReach(geometry, q)) continue;
    std::array<char, 200> text;
    std::snprintf(text.data(), text.size(),
                  "role '%s': at %.2f s the motion leaves the arm's reach: tilt %.1f deg, yaw %.1f deg, length %.0f mm",
                  binding.role.c_str(), t, q[0] * 180 / std::numbers::pi, q[1] * 180 / std::numbers::pi,
                  (q[2] + geometry.length_min) * 1e3);
    diagnostics.error(462, binding.settings.at("pos").where, text.data(),
                      "tilt up to 45 deg, yaw up to 40 deg, length 441 to 1070 mm: move or turn the base (pos, quat)");
    return;
  }
}

std::unique_ptr<Device> create(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const percro::Parameters parameters = percro::paperArm();
  const percro::ArmDynamics dynamics(parameters, Vec3::Zero());
  HandSettings hand = readHand(binding, world, dynamics.inertia(percro::Joints::Zero())[2], diagnostics);
  const auto base = readBase(binding, diagnostics);
  if (hand.motion && base) checkReach(binding, *base, *hand.motion, parameters.geometry, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  return std::make_unique<PercroArm>(*base, std::move(hand), parameters,
                                     RateTable(world.scene.rates).period(RateGroup::kHaptic));
}

const DevicePlugin kPlugin{
    .name = "percro_arm",
    .create = createEach<create>,
    .rating = {.force = 10, .continuous = 4, .heating_time = 30, .behind = DeviceRating::Behind::kModel}};

/// Both arms are switched on and homed, then linked and led through a region of 8 cm around the midpoint between them.
std::vector<LinkedSample> rehearse(const Pose& X_WA, const Pose& X_AB, double link, std::uint64_t seed) {
  constexpr double kSize = 0.08;                      // [m]
  const percro::TipLoad kEmptyThimble{.mass = 0.02};  // [kg]
  const percro::Parameters parameters = percro::paperArm();
  RandomStream stream(seed, "path of the link");
  percro::LinkPath path = percro::randomPath(stream, kSize);
  path.middle = 0.5 * X_AB.p;
  if (!percro::meetAlong(parameters.geometry, X_AB, path, link)) return {};
  const Vec3 gravity_A = X_WA.q.conjugate() * kGravity_W;
  std::array<Vec3, 2> zero_errors;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 gravity = i == 0 ? gravity_A : Vec3(X_AB.q.conjugate() * gravity_A);
    percro::SwitchedOn arm(parameters, gravity, {}, stream);
    if (!arm.home(kEmptyThimble).done()) return {};
    zero_errors[i] = arm.zeroError();
  }
  return percro::moveLinked(parameters, gravity_A, X_AB, path, link, zero_errors);
}

const CalibrationPlugin kCalibration{.centre = percro::linkCentre, .rehearse = rehearse};

const FigurePlugin kFigure{.create = percro::makeDrawnArm};

const CharacterisationPlugin kCharacterisation{.make = [] { return percro::characterise(percro::paperArm()); }};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
PRESA_DEVICE_CHARACTERISATION(presa::kCharacterisation)
PRESA_DEVICE_CALIBRATION(presa::kCalibration)
PRESA_DEVICE_FIGURE(presa::kFigure)
