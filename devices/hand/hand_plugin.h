#pragma once
#include <functional>

#include "devices/hand/hand.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/run_options.h"
#include "framework/scene/world.h"

/// Hands of other drivers for a modelled device: a driver whose manifest says gives="hand" exports the table with
/// PRESA_HAND_PLUGIN, and a device whose manifest has a setting of type "hand" takes it by that driver's name.
namespace presa {

/// The modelled device as the hand that wears it needs to know it.
struct Thimble {
  DeviceBinding binding;                                                    ///< the device's, with the hand's settings
  double carried = 0;                                                       ///< mass that moves with the fingertip [kg]
  std::function<double(const Vec3&)> step = [](const Vec3&) { return 0; };  ///< position step at a place in W [m]
};

struct HandPlugin {
  int abi = kPluginAbi;
  /// One finger for each thimble, in their order; null for one whose settings have an error. Thread: main.
  HandList (*create)(const std::vector<Thimble>& thimbles, const std::shared_ptr<const World>& world,
                     const RunOptions& options, Diagnostics& diagnostics) = nullptr;
};

/// The fingers that the bindings name by their setting `hand` (default: scripted), in the order of `thimbles`. E430: no
/// such hand. Null where there is an error.
HandList makeHands(const std::vector<Thimble>& thimbles, const std::shared_ptr<const World>& world,
                   const RunOptions& options, Diagnostics& diagnostics);

/// HandPlugin::create with one call of `make` for each thimble, for fingers that do not know each other.
template <auto make>
HandList createEachHand(const std::vector<Thimble>& thimbles, const std::shared_ptr<const World>& world,
                        const RunOptions& options, Diagnostics& diagnostics) {
  HandList hands;
  for (const Thimble& thimble : thimbles) hands.push_back(make(thimble, world, options, diagnostics));
  return hands;
}

}  // namespace presa

#define PRESA_HAND_PLUGIN(table) \
  extern "C" __attribute__((visibility("default"))) const presa::HandPlugin* presaHandPlugin() { return &(table); }
