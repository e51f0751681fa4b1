#include "devices/hand/hand_plugin.h"
#include "devices/hand/hand_settings.h"
#include "devices/hand/ideal_device.h"
#include "devices/linking_hand/linked_pair.h"
#include "framework/device/device_plugin.h"
#include "framework/device/device_settings.h"

namespace presa::linking {
namespace {

enum Code { kNotTwo = 390, kNoLeader = 391 };

class LinkingHand final : public Hand {
 public:
  LinkingHand(std::shared_ptr<LinkedPair> pair, std::size_t device) : pair_(std::move(pair)), device_(device) {}

  FingerImpedance impedance() const override {
    return device_ == pair_->settings().leader ? LinkedPair::kLeading : LinkedPair::kLed;
  }
  Vec3 start() const override { return pair_->start(device_); }
  void feel(const Fingertip& tip) noexcept override { pair_->feel(device_, tip); }
  HandPush live(const Tick& tick) noexcept override { return pair_->push(device_, tick); }
  std::vector<Place> path() const override {
    std::vector<Place> path;
    for (double time = 0; time <= LinkedPair::kDuration; time += 0.02)
      path.push_back({time, pair_->tipAt(device_, time)});
    return path;
  }
  std::string model() const override { return "a hand that leads two linked devices: no person"; }

 private:
  std::shared_ptr<LinkedPair> pair_;
  std::size_t device_;
};

/// The settings that one role gives; the bases are those of both.
PairSettings readPair(const std::vector<Thimble>& thimbles, std::size_t role, Diagnostics& diagnostics) {
  PairSettings pair;
  const DeviceBinding& binding = thimbles[role].binding;
  pair.link = positiveSetting(binding, "link", pair.link, diagnostics);
  pair.size = positiveSetting(binding, "size", pair.size, diagnostics);
  const std::vector<double> seed = settingNumbers(binding, "seed");
  if (!seed.empty() && seed[0] >= 0 && seed[0] < 9e15) pair.seed = static_cast<std::uint64_t>(seed[0]);
  for (std::size_t i : {0U, 1U}) {
    const std::vector<double> p = settingNumbers(thimbles[i].binding, "pos");
    if (p.size() == 3) pair.p_WD[i] = {p[0], p[1], p[2]};
  }
  const auto leads = binding.settings.find("leads");
  if (leads == binding.settings.end()) return pair;
  if (leads->second.value == thimbles[0].binding.role)
    pair.leader = 0;
  else if (leads->second.value != thimbles[1].binding.role)
    diagnostics.error(kNoLeader, leads->second.where,
                      "leads must be one of the two roles, found " + quote(leads->second.value),
                      thimbles[0].binding.role + " or " + thimbles[1].binding.role);
  return pair;
}

HandList createHands(const std::vector<Thimble>& thimbles, const std::shared_ptr<const World>& /*world*/,
                     const RunOptions& /*options*/, Diagnostics& diagnostics) {
  HandList hands(thimbles.size());
  if (thimbles.size() != 2) {
    diagnostics.error(kNotTwo, thimbles.front().binding.where,
                      "a linking hand links two devices, found " + std::to_string(thimbles.size()),
                      "give two roles the hand linking_hand");
    return hands;
  }
  const std::size_t before = diagnostics.errorCount();
  const PairSettings settings = readPair(thimbles, 0, diagnostics);
  const bool equal = readPair(thimbles, 1, diagnostics) == settings;
  if (!equal || settings.p_WD[0] == settings.p_WD[1])
    diagnostics.error(kNotTwo, thimbles[1].binding.where,
                      equal ? "a linking hand links devices with two bases, found one place for both"
                            : "role '" + thimbles[1].binding.role + "' has other settings than the other device",
                      equal ? "worn by modelled devices, each with its pos" : "leads, link, size and seed are of both");
  if (diagnostics.errorCount() > before) return hands;
  const auto pair = std::make_shared<LinkedPair>(settings);
  for (std::size_t i : {0U, 1U}) hands[i] = std::make_unique<LinkingHand>(pair, i);
  return hands;
}

const HandPlugin kHand{.create = createHands};
const DevicePlugin kPlugin{.name = "linking_hand", .create = createIdeal<createHands>, .rating = kImaginedRating};

}  // namespace
}  // namespace presa::linking

PRESA_DEVICE_PLUGIN(presa::linking::kPlugin)
PRESA_HAND_PLUGIN(presa::linking::kHand)
