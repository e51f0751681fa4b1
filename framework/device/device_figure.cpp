#include "framework/device/device_figure.h"

#include "framework/scene/manifest.h"

namespace presa {

std::unique_ptr<DeviceFigure> figureOf(const DeviceBinding& binding) {
  const Manifest* manifest = findManifest(binding.driver);
  if (manifest == nullptr || !manifest->hasFigure()) return nullptr;
  return pluginTable<FigurePlugin>(binding.driver, kFigureSymbol).create(binding);
}

}  // namespace presa
