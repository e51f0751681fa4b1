#include <algorithm>
#include <cmath>
#include <memory>

#include "devices/hand/hand_settings.h"
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

/// A tool moved with the mouse.
class PointedTool : public Device {
 public:
  PointedTool(HandSettings settings, bool window)
      : damping_(settings.impedance.damping),
        mass_(settings.impedance.mass),
        notes_(std::move(settings.notes)),
        window_(window) {}

  void open() override {
    if (window_) return;
    refuse(449, "command line", "the rig's fingers are moved with the mouse, which needs a window",
           "add --view window (it needs a display), or use a rig with another driver");
  }
  bool points() const override { return true; }
  double damping() const override { return damping_; }
  double mass() const override { return mass_; }
  std::vector<std::string> notes() const override { return notes_; }

 private:
  double damping_, mass_;
  std::vector<std::string> notes_;
  bool window_;
};

/// One fingertip of the pair.
class PointedFinger final : public PointedTool {
 public:
  PointedFinger(std::shared_ptr<Pair> pair, Pair::Side side, HandSettings settings, bool window)
      : PointedTool(std::move(settings), window), pair_(std::move(pair)), side_(side) {}

  void point(const PointerState& pointer, const Tick&) noexcept override { pair_->point(pointer); }

  FingerInput read(const Tick& tick) noexcept override {
    pair_->advance(tick);
    return {pair_->finger(side_).position(), pair_->finger(side_).velocity(), -1, true};
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    pair_->advance(tick);
    pair_->push(side_, F_H_W.f);
  }

 private:
  std::shared_ptr<Pair> pair_;
  Pair::Side side_;
};

class PointedStylus final : public PointedTool {
 public:
  PointedStylus(const Stylus& stylus, HandSettings settings, bool window)
      : PointedTool(std::move(settings), window), stylus_(stylus) {}

  void point(const PointerState& pointer, const Tick&) noexcept override { stylus_.point(pointer); }
  bool measuresOrientation() const override { return true; }
  FingerInput read(const Tick& tick) noexcept override {
    stylus_.advance(tick);
    return stylus_.sample();
  }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override {
    stylus_.advance(tick);
    stylus_.push(F_H_W);
  }

 private:
  Stylus stylus_;
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
std::unique_ptr<Device> makeFinger(const DeviceBinding& binding, const World& world, bool window,
                                   std::shared_ptr<Pair>& pair, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const Pair::Side side = sideOf(binding, diagnostics) < 0 ? Pair::kThumb : Pair::kIndex;
  HandSettings hand = readImpedance(binding, world, 0, {}, diagnostics);
  const PairSettings settings = readPair(binding, world, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  if (!pair) pair = std::make_shared<Pair>(settings);
  if (!(pair->settings() == settings))
    diagnostics.error(455, binding.where, "role '" + binding.role + "' has other settings than the other finger",
                      "both fingers are one pair: give them the same grip, span, fingertip radius and force limit");
  else if (!pair->add(side, hand.impedance, RateTable(world.scene.rates).period(RateGroup::kHaptic)))
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

DeviceList create(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                  const RunOptions& options, Diagnostics& diagnostics) {
  std::shared_ptr<Pair> pair;  // one mouse moves all fingers
  DeviceList fingers;
  const bool window = options.view == RunOptions::View::kWindow;
  for (const DeviceBinding& binding : bindings) {
    if (!isStylus(binding, diagnostics)) {
      fingers.push_back(makeFinger(binding, *world, window, pair, diagnostics));
      continue;
    }
    fingers.push_back(makeStylus(binding, *world, window, diagnostics));
    if (bindings.size() > 1)
      diagnostics.error(458, binding.where, "role '" + binding.role + "' is a stylus beside other tools of the pointer",
                        "one pointer moves one pair of fingers, or one stylus");
  }
  return fingers;
}

const DevicePlugin kPlugin{.name = "pointer", .create = create, .rating = kImaginedRating};

}  // namespace
}  // namespace presa::pointer

PRESA_DEVICE_PLUGIN(presa::pointer::kPlugin)
