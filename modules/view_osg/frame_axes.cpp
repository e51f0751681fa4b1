#include "modules/view_osg/frame_axes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/device/frame_words.h"
#include "framework/geometry/tangent_frame.h"
#include "modules/view_osg/camera_choice.h"
#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kThickness = 0.012;                    ///< relative to the axis length
constexpr double kRigAxis = 0.06, kFingerAxis = 0.025;  ///< [m]
constexpr float kNameSize = 15, kSentenceSize = 18;     ///< [lines]
constexpr float kLetterWidth = 0.602F;                  ///< of DejaVu Sans Mono, relative to its size
constexpr float kSentenceAt = 236, kHalfLines = 360;    ///< above the middle [lines]
constexpr double kInFrontOfEye = 0.01;                  ///< [m]

float widthOf(const std::string& text, float size) { return kLetterWidth * size * static_cast<float>(text.size()); }

}  // namespace

osg::ref_ptr<osg::Group> axisCross(double length) {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 color = 0.05 * Vec3::Ones() + 0.9 * Vec3::Unit(axis);
    const double thick = kThickness * length;
    osg::ref_ptr<osg::MatrixTransform> shaft =
        new osg::MatrixTransform(alongZ(Vec3::Zero(), Vec3::Unit(axis), {thick, thick, 0.8 * length}));
    shaft->addChild(unitShaft(color));
    osg::ref_ptr<osg::MatrixTransform> head = new osg::MatrixTransform(
        alongZ(0.8 * length * Vec3::Unit(axis), Vec3::Unit(axis), {3 * thick, 3 * thick, 0.2 * length}));
    head->addChild(unitConeUp(color));
    group->addChild(shaft);
    group->addChild(head);
  }
  return group;
}

FrameAxes::FrameAxes(const World& world, osg::Group& space, osg::MatrixTransform& labels, const Ink& ink)
    : world_(world), space_(space), labels_(labels), ink_(ink) {
  const auto& frames = world_.rig.frames;
  for (const DeviceRole& role : world_.scene.devices) {
    const auto device = std::ranges::find(world_.rig.devices, role.role, &DeviceBinding::role);
    const std::string name = device == world_.rig.devices.end() ? kWorldFrame : device->frame;
    stands_.push_back(static_cast<std::size_t>(std::ranges::find(frames, name, &Frame::name) - frames.begin()));
  }
}

void FrameAxes::make() {
  osg::StateSet* state = group_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  space_.addChild(group_);
  labels_.insertChild(0, names_);  // below the help and all panels
  for (const Frame& frame : world_.rig.frames) add(frame.name, kRigAxis);
  for (const DeviceRole& role : world_.scene.devices) add(role.role, kFingerAxis);
  for (const DeviceRole& role : world_.scene.devices) add("face under " + role.role, kFingerAxis);
}

void FrameAxes::add(const std::string& name, double length) {
  Cross cross{.axes = new osg::MatrixTransform, .place = new osg::MatrixTransform};
  cross.axes->addChild(axisCross(length));
  cross.place->setDataVariance(osg::Object::DYNAMIC);
  const float width = widthOf(name, kNameSize);
  cross.place->addChild(roundedPanel({-4, -5, width + 8, kNameSize + 6}, 4, ink_.panel));
  Label(*cross.place, 0, 0, kNameSize, ink_.text, Typeface::kMono).set(name);
  group_->addChild(cross.axes);
  names_->addChild(cross.place);
  crosses_.push_back(cross);
}

void FrameAxes::put(std::size_t cross, const Pose& X_WF) {
  Cross& one = crosses_[cross];
  one.there = true;
  one.p_W = X_WF.p;
  one.axes->setNodeMask(~0U);
  one.axes->setMatrix(toOsg(X_WF));
}

void FrameAxes::hide(std::size_t cross) {
  crosses_[cross].there = false;
  crosses_[cross].axes->setNodeMask(0);
}

void FrameAxes::show(bool shown, const ViewFrame& frame) {
  say(frame.frames);
  shown_ = shown;
  if (shown && crosses_.empty()) make();
  group_->setNodeMask(shown ? ~0U : 0U);
  names_->setNodeMask(shown ? ~0U : 0U);
  if (!shown) return;
  for (std::size_t n = 0; n < world_.rig.frames.size(); ++n) {
    if (frame.frames != nullptr && n < frame.frames->frames.size())
      put(n, frame.frames->frames[n].X_WF);
    else
      hide(n);
  }
  showFingers(frame);
}

/// A fingertip that measures no orientation has the axes of the frame in which its device stands.
Quat FrameAxes::deviceAxes(const ViewFrame& frame, std::size_t finger) const {
  const FingerInput& input = frame.device.fingers[finger];
  if (input.oriented) return input.q_WT;
  const std::size_t n = stands_[finger];
  if (frame.frames == nullptr || n >= frame.frames->frames.size()) return Quat::Identity();
  return frame.frames->frames[n].X_WF.q;
}

void FrameAxes::showFingers(const ViewFrame& frame) {
  const std::size_t first = world_.rig.frames.size(), fingers = stands_.size();
  for (std::size_t f = 0; f < fingers; ++f) {
    hide(first + f);
    hide(first + fingers + f);
    if (f >= frame.contacts.fingers.size() || f >= frame.device.fingers.size() || !frame.device.fingers[f].valid)
      continue;
    const FingerContact& contact = frame.contacts.fingers[f];
    put(first + f, {contact.p_WP, deviceAxes(frame, f)});
    const auto body = static_cast<std::size_t>(contact.body);
    if (contact.mode == ContactMode::kNone || contact.body < 0 || body >= frame.X_WB.size()) continue;
    put(first + fingers + f, frame.X_WB[body] * tangentFrame(contact.nhat_B, contact.p_BC));
  }
}

void FrameAxes::say(const FrameState* frames) {
  std::string text;
  const std::size_t count = frames == nullptr ? 0 : std::min(frames->frames.size(), world_.rig.frames.size());
  for (std::size_t n = 0; n < count && text.empty(); ++n) text = frameSentence(world_.rig.frames[n], frames->frames[n]);
  if (!sentence_) {
    if (text.empty()) return;
    sentence_ = new osg::MatrixTransform(osg::Matrix::translate(0, kSentenceAt, 0));
    panel_ = roundedPanel({0, 0, 1, 1}, 0.3F, ink_.panel);
    sentence_->addChild(panel_);
    labels_.addChild(sentence_);
    text_.emplace_back(*sentence_, 0.0F, 0.0F, kSentenceSize, ink_.text, Typeface::kMono, Label::Align::kCenter);
  }
  sentence_->setNodeMask(text.empty() ? 0U : ~0U);
  text_.front().set(text);
  const float width = widthOf(text, kSentenceSize) + 24;
  const auto panel = roundedPanel({-width / 2, -9, width, kSentenceSize + 14}, 6, ink_.panel);
  panel_->setVertexArray(panel->getVertexArray());
  panel_->setPrimitiveSet(
      0, new osg::DrawArrays(GL_TRIANGLE_FAN, 0, static_cast<int>(panel->getVertexArray()->getNumElements())));
  panel_->dirtyBound();
}

void FrameAxes::seenFrom(const CameraPose& pose) {
  if (!shown_) return;
  const Vec3 forward = (pose.target - pose.eye).normalized(), side = forward.cross(upOf(pose)).normalized();
  const double slope = std::tan(kFieldOfView / 2 * std::numbers::pi / 180);
  std::vector<Vec3> taken;
  for (Cross& cross : crosses_) {
    const Vec3 d = cross.p_W - pose.eye;
    const double depth = d.dot(forward), lines = kHalfLines / (slope * std::max(depth, kInFrontOfEye));
    Vec3 at(std::round(lines * d.dot(side)) + 10, std::round(lines * d.dot(side.cross(forward))) - 24, 0);
    const bool seen = cross.there && depth > kInFrontOfEye && std::abs(at.x()) < labels_.getMatrix().getTrans().x() &&
                      std::abs(at.y()) < kHalfLines;
    cross.place->setNodeMask(seen ? ~0U : 0U);
    if (!seen) continue;
    for (const Vec3& other : taken)
      if (std::abs(other.x() - at.x()) < 120 && std::abs(other.y() - at.y()) < kNameSize + 8)
        at.y() = other.y() - kNameSize - 8;
    taken.push_back(at);
    cross.place->setMatrix(osg::Matrix::translate(at.x(), at.y(), 0));
  }
}

}  // namespace presa::view
