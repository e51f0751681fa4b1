#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

#include "devices/hand/hand_plugin.h"
#include "devices/hand/worn_device.h"
#include "devices/percro_arm/calibration/calibration_plugin.h"
#include "devices/percro_arm/characterise.h"
#include "devices/percro_arm/drawn_arm.h"
#include "devices/percro_arm/linked_arms.h"
#include "devices/percro_arm/properties.h"
#include "devices/percro_arm/switched_on.h"
#include "devices/percro_arm/thimble.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

enum ArmCode { kNoPlace = 460, kBadPlace = 461, kOutOfReach = 462, kNoProperty = 446 };

const Vec3 kGravity_W{0, 0, -9.81};  // of the room, independent of the scene

/// A modelled arm, worn by a finger of a hand. Presa sees it through its encoders.
class PercroArm final : public WornDevice {
 public:
  PercroArm(const Pose& X_WD, std::unique_ptr<Hand> worn_by, const percro::Parameters& parameters, double period)
      : WornDevice(std::move(worn_by)), X_WD_(X_WD), arm_(parameters, X_WD.q.conjugate() * kGravity_W, period) {
    arm_.place(X_WD_.inverseTimes(hand().start()));
    thimble_.place(arm_.state().q);
    feel();
  }

  FingerInput read(const Tick& tick) noexcept override {
    advance(tick);
    FingerInput input = sample(X_WD_ * arm_.reportedPosition(), X_WD_.q * arm_.reportedVelocity(), tick);
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

  std::string model() const override { return modelOf("simulated PERCRO arms", hand().model()); }
  std::vector<DeviceFact> facts() const override {
    std::vector<DeviceFact> facts = hand().facts();
    facts.push_back({"motor_heat", "1", arm_.maxHeat(), true});
    facts.push_back({"least_force_share", "1", arm_.minShare(), true});
    return facts;
  }

 private:
  Fingertip fingertip() const noexcept override {
    return {X_WD_ * arm_.state().x, X_WD_.q * arm_.state().v, X_WD_.q * arm_.tipForce()};
  }
  void move(const HandPush& push, double period) noexcept override {
    const FingerImpedance impedance = hand().impedance();  // without the arm's, which changes from place to place
    arm_.advance({.mass = impedance.mass,
                  .stiffness = impedance.stiffness,
                  .damping = impedance.damping,
                  .target = X_WD_.inverseTimes(push.p_WT),
                  .target_velocity = X_WD_.q.conjugate() * push.v_WT,
                  .force = X_WD_.q.conjugate() * push.with(Vec3::Zero())});
    thimble_.sample(arm_.state().q, arm_.encoders().joints(), period);
  }

  Pose X_WD_;
  percro::SimulatedArm arm_;
  percro::Thimble thimble_;
};

/// Reads `count` numbers; nullopt with an error otherwise.
std::optional<std::vector<double>> numbersOf(const DeviceBinding& binding, const std::string& key, std::size_t count,
                                             const std::string& example, Diagnostics& diagnostics) {
  const auto found = binding.settings.find(key);
  if (found == binding.settings.end()) {
    diagnostics.error(kNoPlace, binding.where,
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
  diagnostics.error(kBadPlace, found->second.where,
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

/// The arm of the paper without the properties that the rig takes away.
percro::Parameters readArm(const DeviceBinding& binding, Diagnostics& diagnostics) {
  percro::Parameters arm = percro::paperArm();
  const auto without = binding.settings.find("without");
  if (without == binding.settings.end()) return arm;
  std::vector<std::string> known;
  std::string list;
  for (const percro::Property& property : percro::properties()) {
    known.emplace_back(property.name);
    list += (list.empty() ? "" : ", ") + known.back();
  }
  for (const std::string& word : percro::removeProperties(without->second.value, arm))
    diagnostics.error(kNoProperty, without->second.where,
                      "the arm has no property " + quote(word) + didYouMean(word, known), "properties: " + list);
  return arm;
}

/// Reports a hand whose path leaves the reach of the arm.
void checkReach(const DeviceBinding& binding, const Pose& X_WD, const Hand& hand, const percro::Geometry& geometry,
                Diagnostics& diagnostics) {
  for (const Hand::Place& place : hand.path()) {
    const percro::Joints q = percro::jointsAt(geometry, X_WD.inverseTimes(place.p_WT));
    if (percro::withinReach(geometry, q)) continue;
    std::array<char, 200> text;
    std::snprintf(text.data(), text.size(),
                  "role '%s': at %.2f s the motion leaves the arm's reach: tilt %.1f deg, yaw %.1f deg, length %.0f mm",
                  binding.role.c_str(), place.time, q[0] * 180 / std::numbers::pi, q[1] * 180 / std::numbers::pi,
                  (q[2] + geometry.length_min) * 1e3);
    diagnostics.error(kOutOfReach, binding.settings.at("pos").where, text.data(),
                      "tilt up to 45 deg, yaw up to 40 deg, length 441 to 1070 mm: move or turn the base (pos, quat)");
    return;
  }
}

/// Position step of the arm where its encoders count; 0 where they do not.
double stepAt(const percro::Parameters& arm, const Pose& X_WD, const Vec3& p_WH) {
  return arm.motors.counted ? percro::transverseStep(arm, X_WD.inverseTimes(p_WH).norm()) : 0;
}

DeviceList create(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                  const RunOptions& options, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  std::vector<Thimble> thimbles;
  std::vector<std::pair<percro::Parameters, Pose>> arms;
  for (const DeviceBinding& binding : bindings) {
    const percro::Parameters arm = readArm(binding, diagnostics);
    const Pose X_WD = readBase(binding, diagnostics).value_or(Pose{});
    const percro::ArmDynamics dynamics(arm, Vec3::Zero());
    thimbles.push_back({.binding = binding,
                        .carried = dynamics.inertia(percro::Joints::Zero())[2],
                        .step = [arm, X_WD](const Vec3& p_WH) { return stepAt(arm, X_WD, p_WH); }});
    arms.emplace_back(arm, X_WD);
  }
  const bool placed = diagnostics.errorCount() == before;
  HandList hands = makeHands(thimbles, world, options, diagnostics);
  for (std::size_t i = 0; i < hands.size() && placed; ++i) {
    if (hands[i]) checkReach(bindings[i], arms[i].second, *hands[i], arms[i].first.geometry, diagnostics);
  }
  DeviceList devices(bindings.size());
  if (diagnostics.errorCount() > before) return devices;
  for (std::size_t i = 0; i < hands.size(); ++i)
    devices[i] = std::make_unique<PercroArm>(arms[i].second, std::move(hands[i]), arms[i].first,
                                             RateTable(world->scene.rates).period(RateGroup::kHaptic));
  return devices;
}

const DevicePlugin kPlugin{
    .name = "percro_arm",
    .create = create,
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
