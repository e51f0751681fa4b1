#include "modules/view_osg/picture.h"

#include <algorithm>
#include <cmath>
#include <osg/ColorMask>

#include "modules/view_osg/landscape.h"

namespace presa::view {
namespace {

constexpr float kBelowRates = 540;    ///< upper edge of a panel below the rates [lines]
constexpr double kFloorRadius = 1.2;  ///< minimum radius of the floor [m]
constexpr double kSunset = 2;         ///< time of the change to evening sun after completion [s]
constexpr double kSeen = 3e-4;        ///< smaller motions are below a quarter of a pixel, in radii of the subject
constexpr double kShades = 8;         ///< shades of a fingertip per newton
constexpr double kFloorReach = 10;    ///< radius of the floor, in radii of the subject
constexpr double kGround = 0.36;      ///< ground shown below an assembly, relative to its height
constexpr double kShadows = 1.0;      ///< extent of shadows with software rendering, in radii of the subject
constexpr double kLitAround = 2.2;    ///< extent of shadows, in radii of the subject

std::vector<Pose> startPoses(const World& world) {
  std::vector<Pose> poses;
  for (const Body& body : world.scene.bodies) poses.push_back(body.X_WB);
  return poses;
}

}  // namespace

Picture::Picture(std::shared_ptr<const World> world, const RunOptions& options)
    : world_(std::move(world)),
      bodies_(*world_),
      glyphs_(*world_),
      parts_(options.show),
      overlays_(*world_),
      neighbourhoods_(*world_),
      relief_(*world_),
      lighting_(casters_, space_->getOrCreateStateSet(), options.picture.light),
      hud_(*world_, options),
      card_(hud_.right(), *world_),
      time_bar_(hud_.center(), world_->scene.assembly ? AssemblyPanel::kTop + 34 : -Hud::kHeight / 2 + 74),
      plots_(hud_.left(), *world_),
      tool_marks_(*world_, *space_),
      field_(*world_, *space_, hud_.left(), inkOn(options.picture.background)),
      joints_(world_->scene, bodies_, *space_, hud_.center(), inkOn(options.picture.background)),
      frame_axes_(*world_, *space_, hud_.center(), inkOn(options.picture.background)),
      ink_(inkOn(options.picture.background)),
      panels_(options.picture.hud == PictureOptions::Hud::kFull || options.picture.legend ||
              parts_[ShownPart::kOffset] || parts_[ShownPart::kPlots] || parts_[ShownPart::kCompliance] ||
              parts_[ShownPart::kHeat]),
      whole_cones_(options.picture.hud != PictureOptions::Hud::kFull || options.picture.camera),
      offsets_top_(options.picture.hud == PictureOptions::Hud::kFull ? kBelowRates : Hud::kHeight - 18) {
  devices_ = ShownDevices::of(*world_, *space_, *finger_casters_, hud_.right(), ink_);
  addGrain(*space_->getOrCreateStateSet(), world_->scene);
  casters_->addChild(bodies_.root());
  finger_casters_->addChild(glyphs_.casters());
  casters_->addChild(finger_casters_);
  if (world_->scene.assembly) guides_ = std::make_unique<Guides>(world_->scene, bodies_);
  if (forVisitors(*world_)) prepareForVisitors(options);
  ViewFrame start;
  start.X_WB = startPoses(*world_);
  updateSubject(start, {});
  const double reach = std::max(kFloorRadius, kFloorReach * enclose(subject_).radius);
  for (osg::Node* part : {static_cast<osg::Node*>(lighting_.passes()), static_cast<osg::Node*>(bodies_.root()),
                          static_cast<osg::Node*>(glyphs_.root()), static_cast<osg::Node*>(overlays_.root()),
                          neighbourhoods_.root(), relief_.root()})
    space_->addChild(part);
  if (guides_) space_->addChild(guides_->root());
  osg::ref_ptr<osg::Node> landscape;
  if (options.picture.background == PictureOptions::Background::kScene) {
    background_ = makeBackground();
    space_->addChild(background_);
    space_->addChild(floor_);
    if (isOutdoors(world_->scene)) {
      ground_ = floorHeight(*world_);
      landscape = makeLandscape(enclose(subject_).center, reach, *ground_);
      space_->addChild(landscape);
    }
  }
  floor_center_ = enclose(subject_).center;
  floor_radius_ = reach;
  still_ = {lighting_.passes(), bodies_.root(), background_, floor_, landscape};
  watch_.emplace(bodies_, lighting_.directions(), lowestPoint(*world_));
  root_->getOrCreateStateSet()->addUniform(new osg::Uniform("crop", osg::Vec2(0, 1)));
  root_->addChild(space_);
  root_->addChild(hud_.camera());
  setQuick(false);
  if (!options.participant) return;
  panel_.emplace(hud_.participantCenter());
  setScreen({});
}

// Fingers that are seen from afar in place of the glyphs of a laboratory, unless those are asked for.
void Picture::prepareForVisitors(const RunOptions& options) {
  finger_marks_ = std::make_unique<FingerMarks>(*world_, world_->scene.devices.size());
  space_->addChild(finger_marks_->root());
  finger_casters_->addChild(finger_marks_->casters());
  if (withMouse(*world_)) show_how_ = std::make_unique<ShowHow>(hud_.left(), world_->scene);
  if (!options.show.empty()) return;
  for (const ShownPart part : {ShownPart::kHips, ShownPart::kProxies, ShownPart::kCones, ShownPart::kForces})
    parts_.set(part, false);
}

void Picture::setScreen(const ParticipantScreen& screen) {
  if (!panel_) return;
  screen_ = screen;
  panel_->show(screen);
  hud_.showFigures(screen.measured);
}

// A participant's screen decides; keys do not.
ShownParts Picture::partsNow() const {
  if (!screen_) return parts_;
  ShownParts parts;
  parts.set(ShownPart::kDevices, false);  // they show what the fingers measure
  parts.set(ShownPart::kVisual, screen_->bodies);
  parts.set(ShownPart::kProxies, screen_->fingertips);
  for (const ShownPart part : {ShownPart::kHips, ShownPart::kCones, ShownPart::kForces})
    parts.set(part, screen_->measured);
  return parts;
}

void Picture::setQuick(bool quick) {
  quick_ = quick;
  lighting_.setQuality(quick ? kQuickLight : kFineLight);
  bodies_.setQuick(quick);
  glyphs_.setQuick(quick);
  if (devices_) devices_->setQuick(quick);
  floor_->removeChildren(0, floor_->getNumChildren());
  floor_->addChild(makeFloor(*world_, floor_center_, floor_radius_,
                             lighting_.reach() * kShadows * floor_radius_ / kFloorReach, quick));
  watch_->measureShapes();
}

void Picture::surround(osg::Group& root) {
  constexpr int kColumns = 64;
  if (background_) {
    const osg::ref_ptr<osg::Node> fine = makeBackground(kColumns);
    space_->replaceChild(background_, fine);
    std::ranges::replace(still_, background_.get(), fine.get());
    background_ = fine;
  }
  // indoors, the wall of the room has the colour of the lower edge of a picture everywhere
  lighting_.setPictureSize(1 << 30, 1 << 30);
  root.getOrCreateStateSet()->addUniform(new osg::Uniform("crop", osg::Vec2(0, 0)));
  lighting_.passes()->getOrCreateStateSet()->setAttribute(new osg::ColorMask);  // whole, whatever the root writes
  root.addChild(space_);
}

void Picture::setSize(int width, int height) { lighting_.setPictureSize(width, height); }

void Picture::updateSubject(const ViewFrame& frame, const std::vector<FingerView>& fingers) {
  subject_.clear();
  const auto& bodies = world_->scene.bodies;
  const bool any_free = std::any_of(bodies.begin(), bodies.end(), [](const Body& body) { return !body.fixed; });
  for (std::size_t i = 0; i < bodies.size() && i < frame.X_WB.size(); ++i)
    if (!bodies[i].fixed || !any_free) subject_.push_back({frame.X_WB[i].p, bodies_.radius(i)});
  if (world_->scene.assembly) {
    for (const AssemblyGoal& goal : world_->scene.assembly->goals)
      subject_.push_back({goal.X_WB.p, bodies_.radius(goal.bodies.front())});
    // the assembly panel covers the lower edge, so show some ground there
    double low = 1e300, high = -1e300;
    for (const Ball& ball : subject_) {
      low = std::min(low, ball.center.z() - ball.radius);
      high = std::max(high, ball.center.z() + ball.radius);
    }
    subject_.push_back({{subject_.back().center.x(), subject_.back().center.y(), low - kGround * (high - low)}, 0});
  }
  for (const FingerView& finger : fingers) {
    if (!finger.valid) continue;
    subject_.push_back({finger.p_WP, finger.radius});
    if (finger.oriented) subject_.push_back({finger.p_WP + kPenLength * (finger.q_WT * Vec3::UnitZ()), 0.0});
    if (finger.isPushed()) subject_.push_back({finger.forceEnd(), 0.0});
    if (!finger.touches() || !whole_cones_ || !parts_[ShownPart::kCones]) continue;
    const auto [height, rim] = coneSize(finger);
    subject_.push_back({finger.p_WC + height * finger.nhat_W, rim});
  }
}

/// Notes what differs from the last frame. True if a shadow moved.
bool Picture::changed(const ViewFrame& frame, const std::vector<FingerView>& fingers, const ShownParts& parts,
                      double radius) {
  if (!quick_) return true;  // everything is drawn in every frame
  if (std::exchange(drawn_parts_, parts) != parts) watch_->changeAll();
  std::vector<osg::Node*> others;
  for (unsigned i = 0; i < space_->getNumChildren(); ++i)
    if (osg::Node* const part = space_->getChild(i); std::ranges::find(still_, part) == still_.end())
      others.push_back(part);
  std::vector<double> appearance;
  for (const FingerView& finger : fingers) {
    const double shades = finger.touches() ? std::round(kShades * finger.normal_force) : -1;
    appearance.insert(appearance.end(), {static_cast<double>(finger.mode), shades});
  }
  if (devices_) devices_->appendAppearance(appearance);
  field_.appendAppearance(appearance);
  if (guides_ && guides_->shown()) appearance.push_back(frame.time);  // they pulsate
  return watch_->update({frame.X_WB, *finger_casters_, others, appearance, kSeen * radius});
}

Vec3 Picture::middleOfGoals() const {
  Vec3 sum = Vec3::Zero();
  for (const AssemblyGoal& goal : world_->scene.assembly->goals) sum += goal.X_WB.p;
  return sum / static_cast<double>(std::max<std::size_t>(1, world_->scene.assembly->goals.size()));
}

void Picture::showOffsets(bool shown, const ViewFrame& frame) {
  if (shown && !offsets_) offsets_.emplace(hud_.right(), offsets_top_, *world_, ink_);
  if (!offsets_) return;
  offsets_->show(shown);
  if (shown) offsets_->update(frame);
}

void Picture::show(const ViewFrame& frame, const GroupTimings& timings) {
  std::vector<FingerView> fingers = fingerViews(*world_, frame);
  if (screen_ && !screen_->measured) fingers = withoutMeasured(std::move(fingers));
  const ShownParts parts = partsNow();
  if (devices_) {
    devices_->takePens(parts, fingers);
    devices_->show(parts, frame,
                   parts[ShownPart::kOffset] ? offsets_top_ - OffsetPanel::heightFor(*world_) - 10 : offsets_top_);
  }
  time_ = frame.time;
  bodies_.setPoses(frame.X_WB);
  bodies_.show(parts[ShownPart::kVisual]);
  glyphs_.update(fingers);
  if (guides_ && frame.guidance) {
    guides_->update(*frame.guidance, frame.X_WB, frame.time);
    const Guidance& told = *frame.guidance;
    finished_for_ = told.finished && forVisitors(*world_) ? frame.time - told.finished_at : -1;
    const double glow = told.finished ? std::min(1.0, (frame.time - told.finished_at) / kSunset) : 0.0;
    if (lighting_.setGlow(glow)) watch_->changeAll();
  }
  if (finger_marks_) finger_marks_->update(fingers, frame.X_WB);
  if (show_how_) show_how_->update(frame, fingers);
  glyphs_.show(parts);
  overlays_.update(parts, frame.X_WB, frame.asleep);
  neighbourhoods_.update(parts[ShownPart::kPatches], frame.neighbourhoods, frame.X_WB);
  relief_.update(parts[ShownPart::kTexture], frame.contacts, frame.X_WB);
  hud_.update(frame, fingers, timings);
  card_.update(frame.X_WB);
  time_bar_.update(frame.time);
  plots_.update(parts[ShownPart::kPlots]);
  showOffsets(parts[ShownPart::kOffset], frame);
  joints_.show(parts[ShownPart::kJoints], frame);
  tool_marks_.show(parts, frame, fingers);
  field_.show(parts[ShownPart::kField], frame, fingers);
  frame_axes_.show(parts[ShownPart::kFrames], frame);
  updateSubject(frame, fingers);
  const Ball focus = enclose(subject_);
  double lit = (quick_ ? lighting_.reach() * kShadows : kLitAround) * focus.radius;
  if (devices_ && !quick_ && parts[ShownPart::kDevices]) lit = std::max(lit, devices_->reachFrom(focus.center));
  if (lighting_.setFocus(focus.center, lit)) watch_->changeAll();
  lighting_.beginFrame(changed(frame, fingers, parts, focus.radius));
}

}  // namespace presa::view
