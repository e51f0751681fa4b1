#include <deque>

#include "framework/session/view_part.h"

namespace presa {
namespace {

const Vec3 kFree{0.10, 0.45, 0.85};
const Vec3 kTouching{1.0, 0.72, 0.02};

/// The path of each fingertip over the last seconds.
class Trail final : public ViewPart {
 public:
  Trail(double length, std::size_t tools) : length_(length), paths_(tools) {}

  void follow(const ViewMoment& moment) override {
    if (moment.time < last_) paths_.assign(paths_.size(), {});  // a recording went back
    last_ = moment.time;
    for (std::size_t tool = 0; tool < paths_.size() && static_cast<int>(tool) < moment.device.count(); ++tool) {
      std::deque<Point>& path = paths_[tool];
      while (!path.empty() && path.front().time < moment.time - length_) path.pop_front();
      if (!moment.device.fingers[tool].valid) continue;
      const bool touching =
          static_cast<int>(tool) < moment.contacts.count() && moment.contacts.fingers[tool].mode != ContactMode::kNone;
      path.push_back({moment.time, moment.device.fingers[tool].p_WH, touching});
    }
  }

  void draw(const ViewMoment&, Canvas& canvas) override {
    for (const std::deque<Point>& path : paths_) {
      for (std::size_t i = 1; i < path.size(); ++i)
        canvas.line(path[i - 1].p_WH, path[i].p_WH, path[i].touching ? kTouching : kFree);
    }
  }

  std::string what() const override { return "draw the path of each fingertip"; }

 private:
  struct Point {
    double time;  // [s]
    Vec3 p_WH;    // [m]
    bool touching;
  };
  double length_;                         // [s]
  double last_ = 0;                       // [s]
  std::vector<std::deque<Point>> paths_;  // of each tool
};

const ViewPartPlugin kPlugin{
    .name = "trail", .create = [](const PluginElement& element, const World& world) -> std::unique_ptr<ViewPart> {
      return std::make_unique<Trail>(element.number("length"), world.scene.devices.size());
    }};

}  // namespace
}  // namespace presa

PRESA_VIEW_PART_PLUGIN(presa::kPlugin)
