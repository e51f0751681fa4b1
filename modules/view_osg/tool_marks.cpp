#include "modules/view_osg/tool_marks.h"

#include <algorithm>
#include <osg/BlendFunc>
#include <osg/Depth>

#include "modules/view_osg/contact_glyphs.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/placed_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kPlaceRadius = 0.0011, kShaftRadius = 0.0006, kHeadRadius = 0.0016, kHeadLength = 0.004;  // [m]
constexpr double kWayRadius = 0.0007;                                                                      // [m]
constexpr float kHandleOpacity = 0.28F;
constexpr double kCrease = 0.6;  // [rad]

osg::ref_ptr<osg::Group> glyphGroup(float opacity) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  osg::StateSet* state = group->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", opacity));
  // inside of a tool or a body they would not be seen
  state->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false));
  state->setRenderBinDetails(12, "DepthSortedBin");
  return group;
}

}  // namespace

void ToolMarks::show(const ShownParts& parts, const ViewFrame& frame, const std::vector<FingerView>& fingers) {
  const bool points = parts[ShownPart::kPoints], coupling = parts[ShownPart::kCoupling];
  if (points && !points_) space_.addChild(points_ = glyphGroup(1));
  if (coupling && !handles_) space_.addChild(handles_ = glyphGroup(kHandleOpacity));
  if (points_) setShown(*points_, points);
  if (handles_) setShown(*handles_, coupling);
  if (points) showPoints(frame);
  if (coupling) showHandles(fingers);
}

ToolMarks::Arrow& ToolMarks::arrow(std::size_t i) {
  while (arrows_.size() <= i) {
    Arrow made;
    made.place = placed(sphereGeometry(kPlaceRadius, kHipColor, kQuick), *points_);
    made.shaft = placed(unitShaft(kArrowColor, kQuick), *points_);
    made.head = placed(unitConeUp(kArrowColor, kQuick), *points_);
    arrows_.push_back(made);
  }
  return arrows_[i];
}

void ToolMarks::showPoints(const ViewFrame& frame) {
  std::size_t used = 0;
  for (const FingerContact& finger : frame.contacts.fingers) {
    if (!finger.has_volume || finger.mode == ContactMode::kNone) continue;
    for (const ToolContact& one : frame.contacts.contactsOf(finger)) {
      const auto body = static_cast<std::size_t>(one.body);
      const double length = kArrowLengthPerNewton * one.f_H_W.norm();
      if (one.body < 0 || body >= frame.X_WB.size() || !(length > 1e-6) || length > kLongestArrow) continue;
      const Arrow& shown = arrow(used++);
      const Vec3 p_W = frame.X_WB[body] * one.p_BP, direction = one.f_H_W.normalized();
      const double head = std::min(kHeadLength, length / 2);
      shown.place->setMatrix(osg::Matrixd::translate(toOsg(p_W)));
      shown.shaft->setMatrix(alongZ(p_W, direction, {kShaftRadius, kShaftRadius, length - head}));
      shown.head->setMatrix(alongZ(p_W + (length - head) * direction, direction, {kHeadRadius, kHeadRadius, head}));
    }
  }
  for (std::size_t i = 0; i < arrows_.size(); ++i) {
    for (osg::Node* node : {arrows_[i].place.get(), arrows_[i].shaft.get(), arrows_[i].head.get()})
      setShown(*node, i < used);
  }
}

void ToolMarks::showHandles(const std::vector<FingerView>& fingers) {
  if (handle_of_.empty()) {
    for (const auto& tool : world_.tools) {
      Handle handle;
      if (tool) {
        handle.copy = placed(meshGeometry(shadeWithCreases(*tool, kCrease), kHipColor), *handles_);
        handle.way = placed(unitShaft(kHipColor, kQuick), *handles_);
      }
      handle_of_.push_back(handle);
    }
  }
  for (std::size_t i = 0; i < handle_of_.size() && i < fingers.size(); ++i) {
    if (!handle_of_[i].copy) continue;
    const FingerView& view = fingers[i];
    const bool held = view.valid && !view.lies;
    const Vec3 way = view.X_WT_wanted.p - view.X_WT.p;
    const bool apart = held && way.norm() > 1e-5;
    setShown(*handle_of_[i].copy, held);
    setShown(*handle_of_[i].way, apart);
    handle_of_[i].copy->setMatrix(toOsg(view.X_WT_wanted));
    if (apart) handle_of_[i].way->setMatrix(alongZ(view.X_WT.p, way, {kWayRadius, kWayRadius, way.norm()}));
  }
}

}  // namespace presa::view
