#include "framework/device/device_plugin.h"

namespace presa {
namespace {

constexpr DeviceRating impatientRating() {
  DeviceRating rating = kImaginedRating;
  rating.watchdog = 0.02;
  return rating;
}

/// A driver whose forces may come from no Object State that is older than 20 ms.
const DevicePlugin kPlugin{.name = "impatient",
                           .create = [](const std::vector<DeviceBinding>&, const std::shared_ptr<const World>&,
                                        const RunOptions&, Diagnostics&) { return DeviceList{}; },
                           .rating = impatientRating()};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
