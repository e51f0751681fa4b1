#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// A driver that makes no device and says nothing.
const DevicePlugin kPlugin{.name = "forgetful",
                           .create = [](const std::vector<DeviceBinding>&, const std::shared_ptr<const World>&,
                                        const RunOptions&, Diagnostics&) { return DeviceList{}; },
                           .rating = kImaginedRating};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
