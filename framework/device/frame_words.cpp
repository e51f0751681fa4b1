#include "framework/device/frame_words.h"

#include <array>
#include <cstdio>

namespace presa {
namespace {

std::string scaleText(double zoom) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "1 mm of the hand is %.2f mm in the scene", zoom);
  return text.data();
}

std::string counted(std::uint32_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

}  // namespace

std::string frameSentence(const Frame& frame, const FrameNow& now) {
  const std::string name = "'" + frame.name + "'", tool = "'" + frame.parent + "'";
  if ((now.doing & kFrameLost) != 0) return name + " stands still: " + tool + ", which carries it, is not tracked.";
  if ((now.doing & kFrameReturns) != 0) return name + " returns to " + tool + ", which is tracked again.";
  if ((now.doing & kFrameWaits) != 0) return name + " waits until no finger in it feels a force.";
  const std::string scale = frame.zoom && now.zoom != 1 ? scaleText(now.zoom) : "";
  if ((now.doing & kFrameClutched) != 0)
    return "Clutch: " + name + " slides under the hand" + (scale.empty() ? "" : "; " + scale) + ".";
  if (!scale.empty()) return std::string("Zoom: ") + scale + ".";
  if ((now.doing & kFrameWalks) != 0) return name + " moves.";
  return {};
}

std::string frameSummary(const Frame& frame, const FrameNow& last) {
  std::string text;
  if (frame.driven())
    text = "moved, clutched or zoomed " + counted(last.uses, "time") + ", " + std::to_string(last.refusals) +
           " of them held up by a force";
  if (last.losses > 0)
    text +=
        (text.empty() ? "'" : "; '") + frame.parent + "', which carries it, was lost " + counted(last.losses, "time");
  return text.empty() ? text : "frame '" + frame.name + "': " + text;
}

}  // namespace presa
