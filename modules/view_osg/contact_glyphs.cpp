#include "modules/view_osg/contact_glyphs.h"

#include <algorithm>
#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Depth>

#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/placed_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kGlowsWith = 4;  ///< normal force at which a fingertip is fully red [N]
constexpr double kHipRadius = 0.0022;
constexpr double kLinkRadius = 0.0007;
constexpr double kPenRadius = 0.003;
constexpr double kShaftRadius = 0.0013;
constexpr double kHeadRadius = 0.0034;
constexpr double kHeadLength = 0.009;
constexpr float kToolOpacity = 0.85F;
constexpr double kToolCrease = 0.6;  ///< angle between faces above which their edge is drawn sharp [rad]
constexpr double kConeShortest = 0.004, kConeLongest = 0.12;  ///< heights [m]

/// Blended, without depth writes, in render bin `order` (after opaque objects).
void makeTranslucent(osg::StateSet& state, int order) {
  state.setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
  state.setRenderBinDetails(order, "DepthSortedBin");
}

}  // namespace

// Blue and orange: nobody who confuses red with green takes one for the other.
Vec3 stateColor(ContactMode mode) {
  switch (mode) {
    case ContactMode::kStick:
      return {0.02, 0.30, 0.95};
    case ContactMode::kSlip:
      return {1.0, 0.26, 0.02};
    case ContactMode::kNone:
      break;
  }
  return {0.42, 0.45, 0.50};
}

ConeSize coneSize(const FingerView& view) {
  const double height = std::clamp(kArrowLengthPerNewton * view.normal_force, kConeShortest, kConeLongest);
  return {height, height * std::max(view.friction_static, 1e-3)};
}

ContactGlyphs::ContactGlyphs(const World& world) : world_(world) {
  root_->setName("contacts");
  osg::StateSet* solid = solid_->getOrCreateStateSet();
  solid->setAttributeAndModes(shaders::glyph());
  solid->addUniform(new osg::Uniform("opacity", 1.0F));
  osg::StateSet* arrows = arrows_->getOrCreateStateSet();
  arrows->setAttributeAndModes(shaders::glyph());
  arrows->addUniform(new osg::Uniform("opacity", 1.0F));
  osg::StateSet* cones = cones_->getOrCreateStateSet();
  cones->setAttributeAndModes(shaders::cone());
  makeTranslucent(*cones, 10);
  osg::StateSet* tips = tips_->getOrCreateStateSet();
  makeTranslucent(*tips, 11);
  tips->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));

  // a HIP inside a body must be visible: where something hides it, draw it translucently on top
  osg::ref_ptr<osg::Group> through = new osg::Group;
  osg::StateSet* ghost = through->getOrCreateStateSet();
  ghost->addUniform(new osg::Uniform("opacity", 0.45F), osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  makeTranslucent(*ghost, 9);
  ghost->setAttributeAndModes(new osg::Depth(osg::Depth::GREATER, 0, 1, false));
  through->addChild(solid_);
  through->addChild(arrows_);

  for (osg::Node* part :
       {static_cast<osg::Node*>(solid_), static_cast<osg::Node*>(arrows_), static_cast<osg::Node*>(through),
        static_cast<osg::Node*>(cones_), static_cast<osg::Node*>(tips_)})
    root_->addChild(part);
  fingers_.resize(world.scene.devices.size());
  setQuick(false);
}

void ContactGlyphs::setQuick(bool quick) {
  tips_->getOrCreateStateSet()->setAttributeAndModes(shaders::skin(quick));
  for (osg::Group* group : {solid_.get(), arrows_.get(), cones_.get(), tips_.get()})
    group->removeChildren(0, group->getNumChildren());
  for (std::size_t i = 0; i < fingers_.size(); ++i)
    fingers_[i] = makeFinger(i < world_.tools.size() ? world_.tools[i].get() : nullptr, quick ? kQuick : kFine);
}

ContactGlyphs::FingerGlyph ContactGlyphs::makeFinger(const TriMesh* tool, const Roundness& round) {
  FingerGlyph finger;
  finger.hip = placed(sphereGeometry(kHipRadius, kHipColor, round), *solid_);
  finger.link = placed(unitShaft(kHipColor, round), *solid_);
  finger.tip = placed(tool != nullptr ? meshGeometry(shadeWithCreases(*tool, kToolCrease), kToolColor)
                                      : sphereGeometry(1, kSkinColor, round),
                      *tips_);
  if (tool != nullptr) {  // a solid thing, through which one still sees where it goes
    osg::StateSet* state = finger.tip->getOrCreateStateSet();
    state->setAttributeAndModes(shaders::glyph());
    state->addUniform(new osg::Uniform("opacity", kToolOpacity));
  }
  finger.pen = placed(unitShaft(kPenColor, round), *solid_);
  finger.shaft = placed(unitShaft(kArrowColor, round), *arrows_);
  finger.head = placed(unitConeUp(kArrowColor, round), *arrows_);
  finger.tip_color = new osg::Uniform("state_color", osg::Vec3());
  finger.tip->getOrCreateStateSet()->addUniform(finger.tip_color);
  finger.pressure = new osg::Uniform("pressure", 0.0F);
  finger.tip->getOrCreateStateSet()->addUniform(finger.pressure);

  osg::ref_ptr<osg::Group> cone = new osg::Group;
  osg::ref_ptr<osg::Geometry> side = unitFrictionCone(Vec3::Ones(), round);
  side->getOrCreateStateSet()->addUniform(new osg::Uniform("opacity", 0.26F));
  osg::ref_ptr<osg::Geometry> rim = unitRim(Vec3::Ones(), round);
  rim->getOrCreateStateSet()->addUniform(new osg::Uniform("opacity", 0.9F));
  cone->addChild(side);
  cone->addChild(rim);
  finger.cone = placed(cone, *cones_);
  finger.cone_color = new osg::Uniform("state_color", osg::Vec3());
  finger.cone->getOrCreateStateSet()->addUniform(finger.cone_color);
  return finger;
}

void ContactGlyphs::update(const std::vector<FingerView>& fingers) {
  for (std::size_t i = 0; i < fingers_.size() && i < fingers.size(); ++i) {
    const FingerView& view = fingers[i];
    FingerGlyph& finger = fingers_[i];
    setShown(*finger.hip, view.valid);
    setShown(*finger.tip, view.valid);
    finger.hip->setMatrix(osg::Matrixd::translate(toOsg(view.p_WH)));
    const Vec3 link = view.p_WP - view.p_WH;
    setShown(*finger.link, view.valid && link.norm() > 1e-5);
    if (link.norm() > 1e-5) finger.link->setMatrix(alongZ(view.p_WH, link, {kLinkRadius, kLinkRadius, link.norm()}));
    finger.tip->setMatrix(toOsg(view.has_volume ? view.X_WT : Pose{view.p_WP, Quat::Identity()}));
    if (!view.has_volume) finger.tip->preMult(osg::Matrixd::scale(view.radius, view.radius, view.radius));
    setShown(*finger.pen, view.valid && view.oriented && !view.has_volume);
    if (view.oriented)
      finger.pen->setMatrix(alongZ(view.p_WP, view.q_WT * Vec3::UnitZ(), {kPenRadius, kPenRadius, kPenLength}));
    finger.tip_color->set(osg::Vec3(toOsg(stateColor(view.mode))));
    const double max = std::min(view.force_limit, kGlowsWith);
    finger.pressure->set(static_cast<float>(view.touches() ? std::min(1.0, view.normal_force / max) : 0.0));
    updateForce(view, finger);
  }
}

void ContactGlyphs::show(const ShownParts& parts) {
  setShown(*solid_, parts[ShownPart::kHips]);
  setShown(*tips_, parts[ShownPart::kProxies]);
  setShown(*cones_, parts[ShownPart::kCones]);
  setShown(*arrows_, parts[ShownPart::kForces]);
}

void ContactGlyphs::updateForce(const FingerView& view, FingerGlyph& finger) {
  const double length = kArrowLengthPerNewton * view.f_H_W.norm();
  const bool pulled = view.isPushed();
  setShown(*finger.shaft, pulled);
  setShown(*finger.head, pulled);
  setShown(*finger.cone, view.touches() && !view.has_volume);
  if (pulled) {
    const Vec3 direction = view.f_H_W.normalized();
    const double head = std::min(kHeadLength, 0.6 * length);
    const double thick = std::min(1.0, head / kHeadLength);
    finger.shaft->setMatrix(
        alongZ(view.forceBegin(), direction, {kShaftRadius * thick, kShaftRadius * thick, length - head}));
    finger.head->setMatrix(alongZ(view.forceBegin() + (length - head) * direction, direction,
                                  {kHeadRadius * thick, kHeadRadius * thick, head}));
  }
  if (!view.touches()) return;
  const auto [height, rim] = coneSize(view);
  finger.cone->setMatrix(alongZ(view.p_WC, view.nhat_W, {rim, rim, height}));
  finger.cone_color->set(osg::Vec3(toOsg(stateColor(view.mode))));
}

}  // namespace presa::view
