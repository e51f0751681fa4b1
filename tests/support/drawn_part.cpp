#include "tests/support/drawn_part.h"

#include "framework/haptics/plugin_object.h"
#include "framework/session/view_part.h"
#include "tests/support/finger_world.h"

namespace presa::test {
namespace {

class Lines final : public Canvas {
 public:
  void line(const Vec3& p_WA, const Vec3& p_WB, const Vec3& color) override { all.push_back({p_WA, p_WB, color}); }
  std::vector<DrawnPart::Line> all;
};

std::unique_ptr<ViewPart> made(const World& world) {
  const PluginElement& element = world.scene.plugin_elements.at(0);
  const auto& table = pluginTable<ViewPartPlugin>(element.plugin, "presaViewPartPlugin");
  return madeFor(element, [&] { return table.create(element, world); });
}

}  // namespace

struct DrawnPart::Parts {
  explicit Parts(const std::string& element) : world(elementWorld(element)), part(made(*world)) {}
  std::shared_ptr<const World> world;
  std::unique_ptr<ViewPart> part;
};

DrawnPart::DrawnPart(const std::string& element) : parts_(std::make_unique<Parts>(element)) {}
DrawnPart::~DrawnPart() = default;

std::vector<DrawnPart::Line> DrawnPart::follow(double time, const Vec3& p_WT, bool touching) {
  DeviceState device(1);
  device.fingers[0].p_WH = p_WT;
  device.fingers[0].valid = true;
  ContactExchange contacts(1);
  contacts.fingers[0].mode = touching ? ContactMode::kStick : ContactMode::kNone;
  const std::vector<Pose> poses(1);
  const ViewMoment moment{time, poses, device, contacts};
  Lines lines;
  parts_->part->follow(moment);
  parts_->part->draw(moment, lines);
  return lines.all;
}

}  // namespace presa::test
