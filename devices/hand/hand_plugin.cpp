#include "devices/hand/hand_plugin.h"

#include <map>

#include "framework/scene/manifest.h"

namespace presa {
namespace {

enum HandCode { kNoSuchHand = 430 };
constexpr const char* kHand = "hand";
constexpr const char* kDefaultHand = "scripted";

std::string handOf(const DeviceBinding& binding) {
  const auto found = binding.settings.find(kHand);
  return found == binding.settings.end() ? kDefaultHand : found->second.value;
}

/// Whether the driver has a hand; an error otherwise.
bool checkHand(const DeviceBinding& binding, Diagnostics& diagnostics) {
  const std::string hand = handOf(binding);
  std::vector<std::string> known;
  for (const Manifest& manifest : manifests()) {
    if (manifest.kind == PluginKind::kDevice && manifest.gives == kHand) known.push_back(manifest.name);
  }
  if (std::ranges::find(known, hand) != known.end()) return true;
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  const auto setting = binding.settings.find(kHand);
  diagnostics.error(kNoSuchHand, setting == binding.settings.end() ? binding.where : setting->second.where,
                    "role '" + binding.role + "': there is no hand " + quote(hand) + didYouMean(hand, known),
                    "hands: " + list);
  return false;
}

}  // namespace

HandList makeHands(const std::vector<Thimble>& thimbles, const std::shared_ptr<const World>& world,
                   const RunOptions& options, Diagnostics& diagnostics) {
  std::map<std::string, std::vector<std::size_t>> fingers;  // of each hand
  for (std::size_t i = 0; i < thimbles.size(); ++i) {
    if (checkHand(thimbles[i].binding, diagnostics)) fingers[handOf(thimbles[i].binding)].push_back(i);
  }
  HandList hands(thimbles.size());
  for (const auto& [driver, places] : fingers) {
    std::vector<Thimble> worn;
    for (const std::size_t place : places) worn.push_back(thimbles[place]);
    HandList made = pluginTable<HandPlugin>(driver, "presaHandPlugin").create(worn, world, options, diagnostics);
    for (std::size_t i = 0; i < made.size() && i < places.size(); ++i) hands[places[i]] = std::move(made[i]);
  }
  return hands;
}

}  // namespace presa
