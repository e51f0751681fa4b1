#include <algorithm>
#include <map>
#include <numbers>

#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

using xml::Element;

enum FrameCode {
  kUnknownFrame = 416,
  kFrameInItself = 417,
  kDuplicateFrame = 418,
  kFrameKeys = 419,
  kZoomBounds = 465,
  kSameButton = 466,
  kFrameSpeed = 468
};

/// Of a frame that moves by itself.
Vec3 velocityOf(const Element& frame) {
  const std::vector<double> v = frame.numbers("velocity");
  return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : Vec3::Zero();
}

/// The frames and roles of a rig by name, with the element that says in which of them it stands.
class FrameCheck {
 public:
  FrameCheck(const Element& root, Diagnostics& diagnostics) : diagnostics_(diagnostics) {
    for (const Element& device : root.children("device")) named_.try_emplace(device.attribute("role"), device);
    for (const Element& frame : root.children("frame")) {
      if (!frame.hasAttribute("name") || frame.flawed("name")) continue;
      const std::string name = frame.attribute("name");
      if (name == kWorldFrame || !named_.try_emplace(name, frame).second)
        diagnostics.error(kDuplicateFrame, frame.where("name"), "the name " + quote(name) + " is taken",
                          "frames and roles have different names, and 'world' is the frame of the scene");
    }
  }

  void run() {
    for (const auto& [name, element] : named_) {
      checkParent(name, element);
      if (element.name() != "frame") continue;
      checkOrientation(element, diagnostics_);
      checkKeys(element);
      checkZoom(element);
      checkButtons(element);
      checkVelocity(element);
    }
  }

 private:
  std::string parentOf(const Element& element) const {
    return element.hasAttribute("in") && !element.flawed("in") ? element.attribute("in") : kWorldFrame;
  }

  void checkParent(const std::string& name, const Element& element) {
    const std::string parent = parentOf(element);
    if (parent != kWorldFrame && !named_.contains(parent)) {
      std::vector<std::string> names{kWorldFrame};
      for (const auto& [other, unused] : named_) names.push_back(other);
      diagnostics_.error(kUnknownFrame, element.where("in"), "there is no frame " + quote(parent),
                         "'world', a <frame> or a role of this rig" + didYouMean(parent, names));
      return;
    }
    std::string path = quote(name);
    std::string at = parent;
    for (std::size_t steps = 0; at != kWorldFrame && steps < named_.size(); ++steps) {
      path += " in " + quote(at);
      if (at == name)
        return diagnostics_.error(kFrameInItself, element.where("in"), quote(name) + " is in itself", path);
      const auto next = named_.find(at);
      if (next == named_.end()) return;
      at = parentOf(next->second);
    }
  }

  void checkKeys(const Element& frame) {
    double last = -1;
    for (const Element& key : frame.children("key")) {
      checkOrientation(key, diagnostics_);
      if (!key.hasAttribute("time") || key.flawed("time")) continue;
      const double time = key.number("time", 0);
      if (!(time > last))
        diagnostics_.error(kFrameKeys, key.where("time"), "times of keys do not grow",
                           "each <key> of a frame is later than the one before");
      last = time;
    }
  }

  void checkZoom(const Element& frame) {
    for (const Element& zoom : frame.children("zoom")) {
      if (!zoom.hasAttribute("min") || !zoom.hasAttribute("max") || zoom.flawed("min") || zoom.flawed("max")) continue;
      if (zoom.number("min", 1) <= 1 && zoom.number("max", 1) >= 1) continue;
      const bool below = zoom.number("min", 1) > 1;
      diagnostics_.error(kZoomBounds, zoom.where(below ? "min" : "max"),
                         "the zoom of frame " + quote(frame.attribute("name")) + " starts at 1, found min=\"" +
                             zoom.attribute("min") + "\" max=\"" + zoom.attribute("max") + "\"",
                         "min is at most 1, max at least 1");
    }
  }

  /// The buttons of one frame: clutch and zoom must be told apart.
  void checkButtons(const Element& frame) {
    std::map<std::string, SourceLocation> used;
    const auto take = [&](const Element& element, const std::string& attribute) {
      if (!element.hasAttribute(attribute) || element.flawed(attribute)) return;
      const auto [first, is_new] = used.try_emplace(element.attribute(attribute), element.where(attribute));
      if (is_new) return;
      diagnostics_.error(
          kSameButton, element.where(attribute),
          "button " + element.attribute(attribute) + " of frame " + quote(frame.attribute("name")) + " does two things",
          "the first is in line " + std::to_string(first->second.line));
    };
    for (const Element& clutch : frame.children("clutch")) take(clutch, "button");
    for (const Element& zoom : frame.children("zoom")) {
      take(zoom, "in");
      take(zoom, "out");
    }
  }

  void checkVelocity(const Element& frame) {
    constexpr double kFastest = 5;  // as the schema's bound of `speed` [m/s]
    if (!frame.hasAttribute("velocity") || frame.flawed("velocity")) return;
    if (velocityOf(frame).cwiseAbs().maxCoeff() <= kFastest) return;
    diagnostics_.error(
        kFrameSpeed, frame.where("velocity"),
        "frame " + quote(frame.attribute("name")) + " would move with velocity=\"" + frame.attribute("velocity") + "\"",
        "each component is at most 5 m/s");
  }

  Diagnostics& diagnostics_;
  std::map<std::string, Element> named_;
};

/// Absent attribute: no button.
Frame::Button readButton(const Element& element, const std::string& attribute) {
  Frame::Button button;
  if (!element.hasAttribute(attribute)) return button;
  button.number = static_cast<int>(element.number(attribute, 0));
  button.where = element.where(attribute);
  return button;
}

void readDrive(const Element& element, Frame& frame) {
  const std::string moves = element.attribute("moves");
  if (moves == "walk") frame.moves = Frame::Moves::kWalk;
  if (moves == "fly") frame.moves = Frame::Moves::kFly;
  frame.speed = element.number("speed", 1);
  frame.turn = element.number("turn_deg", 60) * std::numbers::pi / 180;
  frame.drift = velocityOf(element);
  for (const Element& clutch : element.children("clutch")) frame.clutch = readButton(clutch, "button");
  for (const Element& zoom : element.children("zoom"))
    frame.zoom = {.min = zoom.number("min", 1),
                  .max = zoom.number("max", 1),
                  .rate = zoom.number("rate", 2),
                  .in = readButton(zoom, "in"),
                  .out = readButton(zoom, "out")};
}

Frame readFrame(const Element& element) {
  Frame frame;
  frame.name = element.attribute("name");
  frame.parent = element.attribute("in");
  frame.X_PF = readPose(element);
  for (const Element& key : element.children("key")) frame.keys.push_back({key.number("time", 0), readPose(key)});
  readDrive(element, frame);
  return frame;
}

}  // namespace

void checkFrames(const Element& root, Diagnostics& diagnostics) { FrameCheck(root, diagnostics).run(); }

std::vector<Frame> readFrames(const Element& root) {
  std::vector<Frame> frames;
  for (const Element& frame : root.children("frame")) frames.push_back(readFrame(frame));
  return frames;
}

}  // namespace presa
