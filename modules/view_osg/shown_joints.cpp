#include "modules/view_osg/shown_joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/scene/joints/joint_words.h"
#include "modules/view_osg/camera_choice.h"

namespace presa::view {
namespace {

constexpr float kJointSize = 15, kJointLetter = 0.602F * kJointSize, kPad = 6, kHigh = 22;  // DejaVu Sans Mono; [lines]
constexpr float kAside = 26, kJointAbove = 30;  ///< of a label from its joint [lines]
constexpr float kJointHalfHeight = 360, kJointMargin = 6;
constexpr double kJointNearest = 0.01;  ///< in front of the eye [m]
constexpr double kJump = 0.25;          ///< frames farther apart are not one motion [s]

std::size_t lettersOf(const std::string& utf8) {
  return static_cast<std::size_t>(std::ranges::count_if(utf8, [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

ShownJoints::ShownJoints(const Scene& scene, const BodyNodes& bodies, osg::Group& space, osg::MatrixTransform& labels,
                         const Ink& ink)
    : scene_(scene), bodies_(bodies), space_(space), labels_(labels), ink_(ink) {}

void ShownJoints::make() {
  motion_ = std::make_unique<JointMotion>(scene_);
  glyphs_ = std::make_unique<JointGlyphs>(scene_, *motion_, bodies_);
  space_.addChild(glyphs_->root());
  labels_.insertChild(0, texts_);  // below the help and all panels
  for (std::size_t j = 0; j < motion_->count(); ++j) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->setDataVariance(osg::Object::DYNAMIC);
    texts_->addChild(place);
    osg::ref_ptr<osg::Geometry> panel = roundedPanel({0, 0, 1, kHigh}, 0.4F, ink_.panel);
    place->addChild(panel);
    beside_.push_back({place, panel, Label(*place, kPad, 6, kJointSize, ink_.text, Typeface::kMono)});
  }
}

void ShownJoints::follow(const ViewFrame& frame) {
  if (scene_.joints.empty() || frame.X_WB.size() < scene_.bodies.size()) return;
  if (!motion_) make();
  if (frame.joint_positions != nullptr)
    motion_->goOnFrom(frame.joint_positions->of);
  else if (!(frame.time >= time_ && frame.time - time_ < kJump))
    motion_->goOnFrom();
  time_ = frame.time;
  motion_->follow([&](std::size_t body) { return frame.X_WB[body]; });
}

void ShownJoints::show(bool shown, const ViewFrame& frame) {
  if (shown) follow(frame);
  if (!motion_) return;
  shown_ = shown;
  for (osg::Group* part : {glyphs_->root(), texts_.get()}) part->setNodeMask(shown ? ~0U : 0U);
  if (!shown) return;
  glyphs_->update(*motion_, frame.X_WB);
  for (std::size_t j = 0; j < beside_.size(); ++j) {
    beside_[j].p_W = frame.X_WB[motion_->joint(j).body] * motion_->joint(j).p_BJ;
    write(beside_[j], textOf(j));
  }
}

std::string ShownJoints::textOf(std::size_t j) const {
  const Joint& joint = motion_->joint(j);
  std::string text = joint.name;
  for (std::size_t i = 0; i < positionCount(joint); ++i)
    text += (i == 0 ? " " : ", ") + positionText(joint, i, motion_->position(j, i));
  return text;
}

void ShownJoints::write(JointLabel& label, const std::string& text) {
  label.text.set(text);
  const std::size_t letters = lettersOf(text);
  if (letters == label.letters) return;
  label.letters = letters;
  const float width = kJointLetter * static_cast<float>(letters) + 2 * kPad;
  label.panel->setVertexArray(roundedPanel({0, 0, width, kHigh}, 5, ink_.panel)->getVertexArray());
  label.panel->setPrimitiveSet(
      0, new osg::DrawArrays(GL_TRIANGLE_FAN, 0, static_cast<int>(label.panel->getVertexArray()->getNumElements())));
  label.panel->dirtyBound();
}

// Beside the point and inside the picture; below the labels that it would cover.
Rect ShownJoints::placeOf(const JointLabel& label, double right, double up, const std::vector<Rect>& taken) const {
  const auto half_width = static_cast<float>(labels_.getMatrix().getTrans().x());
  Rect rect{0, 0, kJointLetter * static_cast<float>(label.letters) + 2 * kPad, kHigh};
  rect.x = std::min(std::round(static_cast<float>(right) + kAside), half_width - kJointMargin - rect.width);
  rect.y = std::min(std::round(static_cast<float>(up) + kJointAbove), kJointHalfHeight - kJointMargin - kHigh);
  for (const Rect& other : taken)
    if (rect.x < other.x + other.width && other.x < rect.x + rect.width && rect.y < other.y + kHigh &&
        other.y < rect.y + kHigh)
      rect.y = other.y - kHigh - 2;
  return rect;
}

void ShownJoints::seenFrom(const CameraPose& pose) {
  if (!shown_) return;
  const Vec3 forward = (pose.target - pose.eye).normalized(), side = forward.cross(upOf(pose)).normalized();
  const double slope = std::tan(kFieldOfView / 2 * std::numbers::pi / 180);
  std::vector<Rect> taken;
  for (JointLabel& label : beside_) {
    const Vec3 d = label.p_W - pose.eye;
    const double depth = d.dot(forward), lines = kJointHalfHeight / (slope * std::max(depth, kJointNearest));
    const double right = lines * d.dot(side), up = lines * d.dot(side.cross(forward));
    const bool seen = depth > kJointNearest && std::abs(right) < labels_.getMatrix().getTrans().x() &&
                      std::abs(up) < kJointHalfHeight;
    label.place->setNodeMask(seen ? ~0U : 0U);
    if (!seen) continue;
    taken.push_back(placeOf(label, right, up, taken));
    label.place->setMatrix(osg::Matrixd::translate(taken.back().x, taken.back().y, 0));
  }
}

}  // namespace presa::view
