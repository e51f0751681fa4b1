#include "modules/view_osg/shown_devices.h"

#include "modules/view_osg/placed_nodes.h"

namespace presa::view {
namespace {

constexpr float kApart = 10;  // of two panels [lines]

}  // namespace

ShownDevices::ShownDevices(std::unique_ptr<DeviceFigures> figures, osg::Group& right, const Ink& ink)
    : figures_(std::move(figures)), right_(right), ink_(ink) {
  casters_->addChild(figures_->root());
}

// A quick light ends near the subject and would cut their shadows off.
void ShownDevices::setQuick(bool quick) {
  figures_->setQuick(quick);
  setShown(*casters_, !quick);
}

std::unique_ptr<ShownDevices> ShownDevices::of(const World& world, osg::Group& space, osg::Group& casters,
                                               osg::Group& right, const Ink& ink) {
  std::unique_ptr<DeviceFigures> figures = DeviceFigures::of(world);
  if (!figures) return nullptr;
  space.addChild(figures->root());
  space.addChild(figures->lines());
  std::unique_ptr<ShownDevices> all(new ShownDevices(std::move(figures), right, ink));
  casters.addChild(all->casters_);
  return all;
}

void ShownDevices::takePens(const ShownParts& parts, std::vector<FingerView>& fingers) const {
  if (!parts[ShownPart::kDevices]) return;
  for (std::size_t i = 0; i < fingers.size(); ++i)
    if (figures_->has(i)) fingers[i].oriented = false;
}

void ShownDevices::show(const ShownParts& parts, const ViewFrame& frame, float top) {
  figures_->update(frame, parts);
  top = showPanel(deflections_, DevicePanel::Of::kDeflection, parts[ShownPart::kCompliance], top);
  showPanel(heats_, DevicePanel::Of::kHeat, parts[ShownPart::kHeat], top);
}

float ShownDevices::showPanel(std::optional<DevicePanel>& panel, DevicePanel::Of what, bool shown, float top) {
  if (shown && !panel) panel.emplace(right_, what, figures_->told(), ink_);
  if (!panel) return top;
  panel->show(shown);
  if (!shown) return top;
  panel->place(top);
  panel->update(figures_->told());
  return top - panel->height() - kApart;
}

}  // namespace presa::view
