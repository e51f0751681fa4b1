#include "framework/device/device_plugin.h"

#include "devices/novint_falcon/diagnose.h"
#include "devices/novint_falcon/falcon_device.h"
#include "devices/novint_falcon/rating.h"
#include "devices/novint_falcon/usb_bus.h"

namespace presa {
namespace {

std::unique_ptr<Device> create(const DeviceBinding& binding, const std::shared_ptr<const World>& /*world*/,
                               const RunOptions& options, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  falcon::FalconSettings settings = falcon::readSettings(binding, options, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  auto connect = [serial = settings.serial, where = settings.where] { return falcon::connectOverUsb(serial, where); };
  return std::make_unique<falcon::FalconDevice>(std::move(settings), std::move(connect));
}

const DevicePlugin kPlugin{.name = "novint_falcon",
                           .create = createEach<create>,
                           .diagnose = falcon::diagnose,
                           .udev_rule = falcon::kUdevRule,
                           .rating = falcon::kRating,
                           .hardware = true,
                           .while_opening = "while its light is blue, pull the grip all the way out, then push it in"};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
