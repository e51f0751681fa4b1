#include <algorithm>
#include <cmath>
#include <memory>

#include "devices/hand/hand_plugin.h"
#include "devices/hand/hand_settings.h"
#include "devices/hand/ideal_device.h"
#include "devices/pointer/pair.h"
#include "devices/pointer/stylus.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa::pointer {
namespace {

constexpr double kMaxGrip = 6;         // [N], unless the rig or the scene sets less
constexpr double kShareOfLimit = 0.6;  // of the force limit; the rest is for weight and obstacles
constexpr double kSpan = 0.12;         // [m]
constexpr double kAbove = 0.05;        // [m] initial height above all free bodies

/// Refuses a run without a window.
void needWindow(bool window) {
  if (window) return;
  refuse(449, "command line", "the rig's fingers are moved with the mouse, which needs a window",
         "add --view window (it needs a display), or use a rig with another driver");
}

/// One finger of the pair.
class PointedFinger final : public Hand {
 public:
  PointedFinger(std::shared_ptr<Pair> pair, Pair::Side side, HandSettings settings, bool window)
      : pair_(std::move(pair)), side_(side), settings_(std::move(settings)), window_(window) {}

  void open() override { needWindow(window_); }
  FingerImpedance impedance() const override { return settings_.impedance; }
  Vec3 start() const override { return pair_->start(side_); }
  bool points() const override { return true; }
  void point(const PointerState& pointer) noexcept override { pair_->point(pointer); }
  void feel(const Fingertip& tip) noexcept override { pair_->feel(side_, tip); }
  HandPush live(const Tick& tick) noexcept override { return pair_->live(side_, tick); }
  std::vector<std::string> notes() const override { return settings_.notes; }

 private:
  std::shared_ptr<Pair> pair_;
  Pair::Side side_;
  HandSettings settings_;
  bool window_;
};

/// A pen moved with the mouse.
class PointedStylus final : public Device {
 public:
  PointedStylus(const Stylus& stylus, HandSettings settings, bool window)
      : stylus_(stylus), settings_(std::move(settings)), window_(window) {}

  void open() override { needWindow(window_); }
  bool points() const override { return true; }
  void point(const PointerState& pointer, const Tick&) noexcept override { stylus_.point(pointer); }
  bool measuresOrientation() const override { return true; }
  int buttons() const override { return kPickUpButton + 1; }
  FingerInput read(const Tick& tick) noexcept override {
    stylus_.advance(tick);
    return stylus_.sample();
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    stylus_.advance(tick);
    stylus_.push(F_H_W);
  }
  double damping() const override { return settings_.impedance.damping; }
  double mass() const override { return settings_.impedance.mass; }
  std::vector<std::string> notes() const override { return settings_.notes; }

 private:
  Stylus stylus_;
  HandSettings settings_;
  bool window_;
};

/// Distance from a body's origin to its farthest point [m].
double reachOf(const Geometry& geometry, const TriMesh* mesh) {
  return geometry.X_BG.p.norm() + (mesh != nullptr ? radiusOf(*mesh) : boundingRadius(geometry.shape));
}

/// Start position: above the first free body, clear of all free ones; without free bodies, above the world's origin.
Vec3 startOf(const World& world) {
  Vec3 start(0, 0, 0);
  double top = 0.1;
  bool found = false;
  for (std::size_t i = 0; i < world.scene.bodies.size(); ++i) {
    const Body& body = world.scene.bodies[i];
    if (body.fixed || !body.haptic) continue;
    if (!std::exchange(found, true)) start = body.X_WB.p;
    top = std::max(top, body.X_WB.p.z() + reachOf(*body.haptic, world.meshes[i].haptic.get()));
  }
  start.z() = top + kAbove;
  return start;
}

PairSettings readPair(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics) {
  PairSettings pair;
  double force = kMaxGrip;
  for (const DeviceRole& role : world.scene.devices) {
    if (role.role != binding.role) continue;
    force = std::min(force, kShareOfLimit * role.limits.force);
    pair.push = role.limits.force;
    pair.fingertip = role.fingertip_radius;
  }
  pair.grip = positiveSetting(binding, "grip", force, diagnostics);
  pair.span = positiveSetting(binding, "span", kSpan, diagnostics);
  pair.start = startOf(world);
  return pair;
}

/// The finger that `binding` names, of `pair`, which the first finger creates and the second joins. Null with a
/// finding.
std::unique_ptr<Hand> makeFinger(const Thimble& thimble, const World& world, bool window, std::shared_ptr<Pair>& pair,
                                 Diagnostics& diagnostics) {
  const DeviceBinding& binding = thimble.binding;
  const std::size_t before = diagnostics.errorCount();
  const Pair::Side side = sideOf(binding, diagnostics) < 0 ? Pair::kThumb : Pair::kIndex;
  HandSettings hand = readImpedance(binding, world, thimble.carried, {}, diagnostics);
  const PairSettings settings = readPair(binding, world, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  if (!pair) pair = std::make_shared<Pair>(settings);
  if (!(pair->settings() == settings))
    diagnostics.error(455, binding.where, "role '" + binding.role + "' has other settings than the other finger",
                      "both fingers are one pair: give them the same grip, span, fingertip radius and force limit");
  else if (!pair->add(side, hand.impedance.stiffness))
    diagnostics.error(456, binding.where, "role '" + binding.role + "' has a side that another role already has",
                      "one pointer moves one thumb and one index finger; side=\"-1\" is the thumb's");
  if (diagnostics.errorCount() > before) return nullptr;
  return std::make_unique<PointedFinger>(pair, side, std::move(hand), window);
}

/// Whether the rig makes the role a stylus: tool="stylus".
bool isStylus(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const auto found = binding.settings.find("tool");
  if (found == binding.settings.end() || found->second.value == "finger") return false;
  if (found->second.value != "stylus")
    diagnostics.error(457, found->second.where, "tool must be finger or stylus, found " + quote(found->second.value));
  return true;
}

/// Null with a finding.
std::unique_ptr<Device> makeStylus(const DeviceBinding& binding, const World& world, bool window,
                                   Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  refuseUnknownSettings(binding, {"tool", "mass", "stiffness", "damping"}, diagnostics);
  HandSettings hand = readImpedance(binding, world, 0, {}, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  const Stylus stylus(startOf(world), readPair(binding, world, diagnostics).push, hand.impedance,
                      RateTable(world.scene.rates).period(RateGroup::kHaptic));
  return std::make_unique<PointedStylus>(stylus, std::move(hand), window);
}

HandList createHands(const std::vector<Thimble>& thimbles, const std::shared_ptr<const World>& world,
                     const RunOptions& options, Diagnostics& diagnostics) {
  std::shared_ptr<Pair> pair;  // one mouse moves all fingers
  HandList fingers;
  for (const Thimble& thimble : thimbles)
    fingers.push_back(makeFinger(thimble, *world, options.view == RunOptions::View::kWindow, pair, diagnostics));
  return fingers;
}

DeviceList create(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                  const RunOptions& options, Diagnostics& diagnostics) {
  const auto stylus =
      std::ranges::find_if(bindings, [&](const DeviceBinding& binding) { return isStylus(binding, diagnostics); });
  if (stylus == bindings.end()) return createIdeal<createHands>(bindings, world, options, diagnostics);
  if (bindings.size() > 1)
    diagnostics.error(458, stylus->where, "role '" + stylus->role + "' is a stylus beside other tools of the pointer",
                      "one pointer moves one pair of fingers, or one stylus");
  DeviceList tools(bindings.size());
  tools[static_cast<std::size_t>(stylus - bindings.begin())] =
      makeStylus(*stylus, *world, options.view == RunOptions::View::kWindow, diagnostics);
  return tools;
}

const HandPlugin kHand{.create = createHands};
const DevicePlugin kPlugin{.name = "pointer", .create = create, .rating = kImaginedRating};

}  // namespace
}  // namespace presa::pointer

PRESA_DEVICE_PLUGIN(presa::pointer::kPlugin)
PRESA_HAND_PLUGIN(presa::pointer::kHand)
