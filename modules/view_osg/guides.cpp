#include "modules/view_osg/guides.h"

#include <cmath>
#include <numbers>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Depth>

#include "framework/scene/goal_pose.h"
#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

const Vec3 kPlaceColor(0.30, 0.85, 0.45), kMissingColor(1.0, 0.52, 0.08), kArrow(1.0, 0.62, 0.05);
constexpr float kFaint = 0.16F, kStrong = 0.30F;
constexpr double kPulsePeriod = 1.4;                                   // period of pulsation [s]
constexpr double kArrowHead = 0.016, kShaft = 0.006, kLength = 0.036;  // sizes of the arrow [m]
constexpr double kAbove = 0.008, kBob = 0.005;  // mean height over the block, and its variation [m]

/// Pulsation between 0 and 1.
float pulse(double time) {
  return static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * time / kPulsePeriod));
}

}  // namespace

Guides::Guides(const Scene& scene, BodyNodes& bodies) : scene_(scene), bodies_(bodies) {
  root_->setName("guides");
  place_ = makeOutline(kPlaceColor);
  missing_ = makeOutline(kMissingColor);

  // tip down
  osg::ref_ptr<osg::MatrixTransform> head =
      new osg::MatrixTransform(alongZ({0, 0, kArrowHead}, -Vec3::UnitZ(), {0.010, 0.010, kArrowHead}));
  head->addChild(unitConeUp(kArrow));
  osg::ref_ptr<osg::MatrixTransform> shaft = new osg::MatrixTransform(
      alongZ({0, 0, kArrowHead}, Vec3::UnitZ(), {kShaft / 2, kShaft / 2, kLength - kArrowHead}));
  shaft->addChild(unitShaft(kArrow));
  arrow_->addChild(head);
  arrow_->addChild(shaft);
  arrow_->setDataVariance(osg::Object::DYNAMIC);
  arrow_->setNodeMask(0);
  osg::StateSet* state = arrow_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  root_->addChild(arrow_);
}

Guides::Outline Guides::makeOutline(const Vec3& color) {
  Outline outline{new osg::MatrixTransform, new osg::Uniform("opacity", kFaint), kNoBody};
  outline.place->setDataVariance(osg::Object::DYNAMIC);
  outline.place->setNodeMask(0);
  osg::StateSet* state = outline.place->getOrCreateStateSet();
  // a model has programs of its own
  state->setAttributeAndModes(shaders::cone(), osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  state->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
  state->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
  state->setRenderBinDetails(8, "DepthSortedBin");
  state->addUniform(outline.opacity);
  state->addUniform(new osg::Uniform("state_color", osg::Vec3(toOsg(color))));
  root_->addChild(outline.place);
  return outline;
}

void Guides::show(Outline& outline, std::int32_t goal, std::int32_t body, const std::vector<Pose>& X_WB,
                  float opacity) {
  const bool shown = goal != kNoGoal && body != kNoBody;
  outline.place->setNodeMask(shown ? ~0U : 0U);
  if (!shown) return;
  if (outline.body != body) {
    outline.place->removeChildren(0, outline.place->getNumChildren());
    if (osg::Node* shape = bodies_.shape(static_cast<std::size_t>(body))) outline.place->addChild(shape);
    outline.body = body;
  }
  const AssemblyGoal& place = scene_.assembly->goals[static_cast<std::size_t>(goal)];
  outline.place->setMatrix(toOsg(nearestTurn(place.X_WB, place.fold, X_WB[static_cast<std::size_t>(body)].q)));
  outline.opacity->set(opacity);
}

void Guides::showArrow(std::int32_t body, const std::vector<Pose>& X_WB, double time) {
  arrow_->setNodeMask(body != kNoBody ? ~0U : 0U);
  if (body == kNoBody) return;
  const auto i = static_cast<std::size_t>(body);
  const Vec3 above(0, 0, bodies_.radius(i) + kAbove + kBob * pulse(time));
  arrow_->setMatrix(toOsg(Pose{X_WB[i].p + above, Quat::Identity()}));
}

bool Guides::shown() const {
  return place_.place->getNodeMask() != 0 || missing_.place->getNodeMask() != 0 || arrow_->getNodeMask() != 0;
}

void Guides::update(const Guidance& guidance, const std::vector<Pose>& X_WB, double time) {
  const bool hint = guidance.hint_goal != kNoGoal;
  const std::int32_t goal = hint ? guidance.hint_goal : guidance.held ? guidance.goal : kNoGoal;
  const std::int32_t body = hint ? guidance.hint_body : guidance.body;
  show(place_, goal, body, X_WB, hint ? kFaint + (kStrong - kFaint) * pulse(time) : kFaint);
  // any of the bodies that fit has the right shape
  const std::int32_t missing = guidance.missing;
  const std::int32_t like =
      missing == kNoGoal
          ? kNoBody
          : static_cast<std::int32_t>(scene_.assembly->goals[static_cast<std::size_t>(missing)].bodies.front());
  show(missing_, missing, like, X_WB, kFaint + (kStrong - kFaint) * pulse(time));
  showArrow(hint && !(guidance.held && guidance.body == guidance.hint_body) ? guidance.hint_body : kNoBody, X_WB, time);
}

}  // namespace presa::view
