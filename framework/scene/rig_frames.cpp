#include <algorithm>
#include <map>

#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

using xml::Element;

enum Code { kUnknownFrame = 416, kFrameInItself = 417, kDuplicateFrame = 418, kFrameKeys = 419 };

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

  Diagnostics& diagnostics_;
  std::map<std::string, Element> named_;
};

Frame readFrame(const Element& element) {
  Frame frame;
  frame.name = element.attribute("name");
  frame.parent = element.attribute("in");
  frame.X_PF = readPose(element);
  for (const Element& key : element.children("key")) frame.keys.push_back({key.number("time", 0), readPose(key)});
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
