#include "modules/view_osg/hud.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <osg/BlendFunc>
#include <osg/Depth>

#include "framework/device/output_stage.h"
#include "modules/view_osg/contact_glyphs.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/ink.h"
#include "modules/view_osg/legend.h"
#include "modules/view_osg/visit_screen.h"

namespace presa::view {
namespace {

const osg::Vec4 kAlarm(1.0F, 0.42F, 0.36F, 1);
const osg::Vec4 kGripInk(0.36F, 0.72F, 1.0F, 1);
constexpr float kCardWidth = 262, kCardHeight = 61, kCardPitch = 66, kCardsTop = 636;
constexpr float kRatesWidth = 268, kSentenceLeft = 168;

const char* stateWord(const FingerView& finger) {
  if (!finger.valid) return "no signal";
  switch (finger.mode) {
    case ContactMode::kStick:
      return "stick";
    case ContactMode::kSlip:
      return "slip";
    case ContactMode::kNone:
      break;
  }
  return "no contact";
}

/// The most severe action of the output stage in words; empty when the forces went out as rendered.
std::string outputWords(std::uint32_t status) {
  if (status & kOutputNotFinite) return "output: not a number, forces off";
  if (status & kOutputLost) return "output: device lost, forces off";
  if (status & kOutputSpeed) return "output: too fast, forces off";
  if (status & kOutputWatchdog) return "output: data too old, forces off";
  if (status & kOutputWarm) return "output: motors are warm";
  if (status & kOutputMagnitude) return "output: at force limit";
  if (status & kOutputFading) return "output: fading";
  if (status & kOutputSlew) return "output: at slew limit";
  return {};
}

}  // namespace

Hud::Hud(const World& world, const RunOptions& options)
    : world_(world), level_(options.picture.hud), ink_(inkOn(options.picture.background)), plain_(forVisitors(world)) {
  camera_->setName("head-up display");
  camera_->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  camera_->setViewMatrix(osg::Matrixd::identity());
  camera_->setRenderOrder(osg::Camera::POST_RENDER);
  camera_->setClearMask(0);
  camera_->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera_->setCullingActive(false);
  camera_->setAllowEventFocus(false);
  osg::StateSet* state = content_->getOrCreateStateSet();
  state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  state->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  // over a transparent picture, the result is multiplied by its opacity
  state->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA,
                                                 osg::BlendFunc::ONE, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  // draw in the order of the graph: panels first, then their text (set on the camera itself, this would sort its
  // parent)
  state->setRenderBinDetails(0, "TraversalOrderBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  camera_->addChild(content_);
  content_->addChild(figures_);
  content_->addChild(participant_);
  figures_->addChild(left_);
  figures_->addChild(right_);
  figures_->addChild(center_);
  right_->addChild(right_figures_);
  left_->addChild(left_figures_);
  center_->addChild(legend_);
  center_->addChild(task_);
  left_->addChild(title_);
  if (world.scene.assembly) {
    assembly_.emplace(*task_);
    right_figures_->setNodeMask(0);
    left_figures_->setNodeMask(0);
    legend_->setNodeMask(0);
  }
  center_->addChild(help_);

  addTitle(world);
  if (options.view == RunOptions::View::kWindow && !plain_ && !assembly_ && level_ == Level::kFull)
    addSentence(world.scene.description);
  for (std::size_t i = 0; i < world.scene.devices.size(); ++i) addCard(i);
  if (cards_.size() > 1) addGrip();
  grip_scale_ = maxGripForce(world.scene.devices);
  addRates(world, options.bus.has_value());
  addLegend(options.view == RunOptions::View::kWindow);
  help_->setNodeMask(0);
  if (options.picture.legend) {
    legend_->setNodeMask(0);  // it says the same, in small letters
    view::addLegend(*right_, assembly_ && level_ == Level::kFull ? kHeight / 2 + AssemblyPanel::kTop + 12 : kMargin,
                    ink_);
  }
  reduce();
  setAspect(16.0 / 9.0);
}

// What other options ask for (legend, parts) stays, and so does help.
void Hud::reduce() {
  if (level_ == Level::kFull) return;
  for (osg::Group* part : {left_figures_.get(), right_figures_.get(), task_.get(), notes_.get()}) part->setNodeMask(0);
  legend_->setNodeMask(0);
  if (level_ == Level::kOff) return title_->setNodeMask(0);
  scale_bar_.emplace(*title_, ink_);
}

void Hud::seenFrom(const CameraPose& pose) {
  if (scale_bar_) scale_bar_->update(pose);
}

void Hud::setAspect(double aspect) {
  const double width = kHeight * aspect;
  camera_->setProjectionMatrixAsOrtho(0, width, 0, kHeight, -1, 1);
  right_->setMatrix(osg::Matrixd::translate(width, 0, 0));
  center_->setMatrix(osg::Matrixd::translate(width / 2, kHeight / 2, 0));
  participant_->setMatrix(center_->getMatrix());
  if (menu_) menu_->setAspect(aspect);
  // between the time and the rates
  const double room = (width - kSentenceLeft - kRatesWidth - 2 * kMargin) / std::max(sentence_width_, 1.0F);
  const double small = std::clamp(room, 0.5, 1.0);
  sentence_->setMatrix(osg::Matrixd::scale(small, small, 1) * osg::Matrixd::translate(kSentenceLeft, kHeight - 67, 0));
  const double share = std::min(1.0, (width - 20) / legend_width_);  // a narrow picture has it smaller
  legend_->setMatrix(osg::Matrixd::translate(0, kHeight / 2, 0) * osg::Matrixd::scale(share, share, 1) *
                     osg::Matrixd::translate(0, -kHeight / 2, 0));
}

void Hud::showFigures(bool shown) { figures_->setNodeMask(shown ? ~0U : 0U); }

void Hud::toggleHelp() {
  help_->setNodeMask(~help_->getNodeMask());
  if (!assembly_ || plain_ || level_ != Level::kFull) return;
  right_figures_->setNodeMask(help_->getNodeMask());
  left_figures_->setNodeMask(help_->getNodeMask());
}

void Hud::tell(const std::string& message) {
  if (level_ != Level::kOff) return message_->set(message);
  std::fprintf(stderr, "\r\033[K%s\n", message.c_str());  // nothing may be drawn
}

void Hud::setBanner(const std::string& text, bool alarm) {
  if (level_ == Level::kOff) return;
  if (!banner_ && assembly_) {  // what a visitor is told is read before any sky
    banner_panel_ = roundedPanel({-440, kHeight / 2 - 94, 880, 36}, 12, {0.06F, 0.055F, 0.05F, 0.72F});
    center_->addChild(banner_panel_);
  }
  if (banner_panel_) banner_panel_->setNodeMask(text.empty() ? 0U : ~0U);
  if (!banner_)
    banner_.emplace(*center_, 0, kHeight / 2 - (assembly_ ? 83 : 34), assembly_ ? 18 : 15, ink_.text, Typeface::kBold,
                    Label::Align::kCenter);
  banner_->set(text);
  banner_->setColor(alarm ? kAlarm : ink_.text);
}

void Hud::addTitle(const World& world) {
  osg::Group& parent = plain_ ? *left_figures_ : *title_;
  Label title(parent, kMargin + 2, kHeight - 42, 25, ink_.text, Typeface::kBold);
  title.set(world.scene.name.empty() ? "scene" : world.scene.name);
  time_.emplace(parent, kMargin + 2, kHeight - 67, 16, ink_.soft, Typeface::kMono);
}

/// What the scene shows, beside its time: for people at a window. Still pictures stay without it.
void Hud::addSentence(const std::string& sentence) {
  constexpr float kSize = 15;
  sentence_width_ = 0.55F * kSize * static_cast<float>(sentence.size());
  title_->addChild(sentence_);
  Label(*sentence_, 0, 0, kSize, ink_.text).set(sentence);
}

void Hud::offerScenes(const std::vector<OfferedScene>& scenes, std::size_t now) {
  menu_.emplace(*center_, ink_, scenes, now);
  tell("m: menu of all scenes");
}

void Hud::addCard(std::size_t index) {
  const float top = kCardsTop - kCardPitch * static_cast<float>(index), bottom = top - kCardHeight;
  const float right = kMargin + kCardWidth;
  left_figures_->addChild(roundedPanel({kMargin, bottom, kCardWidth, kCardHeight}, 8, ink_.panel));
  osg::ref_ptr<osg::Geometry> lamp = dot(right - 16, top - 15, 5.5F, ink_.soft);
  left_figures_->addChild(lamp);
  Card card{Label(*left_figures_, kMargin + 12, top - 20, 15, ink_.text, Typeface::kBold),
            Label(*left_figures_, right - 28, top - 20, 13, ink_.text, Typeface::kRegular, Label::Align::kRight),
            Label(*left_figures_, kMargin + 12, top - 38, 13, ink_.text, Typeface::kMono),
            Label(*left_figures_, right - 12, top - 54, 11.5F, ink_.soft, Typeface::kRegular, Label::Align::kRight),
            Bar(*left_figures_, {kMargin + 12, top - 53, 114, 7}, ink_.track),
            lamp};
  cards_.push_back(std::move(card));
}

void Hud::addGrip() {
  const float top = kCardsTop - kCardPitch * static_cast<float>(cards_.size()), bottom = top - 42;
  left_figures_->addChild(roundedPanel({kMargin, bottom, kCardWidth, 42}, 8, ink_.panel));
  Label name(*left_figures_, kMargin + 12, top - 18, 14, ink_.text, Typeface::kBold);
  name.set("grip force");
  grip_value_.emplace(*left_figures_, kMargin + kCardWidth - 12, top - 18, 13, ink_.text, Typeface::kMono,
                      Label::Align::kRight);
  grip_bar_.emplace(*left_figures_, Rect{kMargin + 12, top - 34, kCardWidth - 24, 7}, ink_.track);
}

void Hud::addRates(const World& world, bool bus) {
  const Rates& rates = world.scene.rates;
  constexpr float kWidth = kRatesWidth, kTop = kHeight - 18, kRow = 19.5F;
  std::vector<std::pair<RateGroup, double>> groups{{RateGroup::kHaptic, rates.haptic},
                                                   {RateGroup::kCollision, rates.collision},
                                                   {RateGroup::kDynamics, rates.dynamics},
                                                   {RateGroup::kView, rates.view}};
  if (bus) groups.emplace_back(RateGroup::kBus, rates.bus);
  const float height = 26 + kRow * static_cast<float>(groups.size());
  right_figures_->addChild(roundedPanel({-kMargin - kWidth, kTop - height, kWidth, height}, 8, ink_.panel));
  const float left = -kMargin - kWidth + 12, right = -kMargin - 12;
  Label head_rate(*right_figures_, right - 82, kTop - 17, 11, ink_.soft, Typeface::kRegular, Label::Align::kRight);
  head_rate.set("rate");
  Label head_missed(*right_figures_, right, kTop - 17, 11, ink_.soft, Typeface::kRegular, Label::Align::kRight);
  head_missed.set("late ticks");
  float y = kTop - 36;
  for (const auto& [group, nominal] : groups) {
    Label name(*right_figures_, left, y, 13, ink_.text);
    name.set(toString(group));
    rates_.push_back({group, nominal,
                      Label(*right_figures_, right - 82, y, 13, ink_.text, Typeface::kMono, Label::Align::kRight),
                      Label(*right_figures_, right, y, 13, ink_.text, Typeface::kMono, Label::Align::kRight)});
    y -= kRow;
  }
  right_->addChild(notes_);
  output_.emplace(plain_ ? *right_figures_ : *notes_, -kMargin - 4, kTop - height - 20, 14, kAlarm, Typeface::kBold,
                  Label::Align::kRight);
}

void Hud::addLegend(bool interactive) {
  constexpr float kY = 27;
  const float width = interactive ? 904 : 826, left = -width / 2;
  legend_width_ = width;
  legend_->addChild(roundedPanel({left, -kHeight / 2 + 10, width, 34}, 8, ink_.panel));
  osg::ref_ptr<osg::MatrixTransform> strip =
      new osg::MatrixTransform(osg::Matrixd::translate(left + 12, -kHeight / 2, 0));
  legend_->addChild(strip);
  const auto entry = [&](float x, const char* words) {
    Label label(*strip, x, kY - 4.5F, 12.5F, ink_.text);
    label.set(words);
  };
  strip->addChild(dot(8, kY, 5, displayed(kHipColor)));
  entry(20, "HIP");
  strip->addChild(dot(66, kY, 9, displayed(kSkinColor)));
  entry(82, "fingertip (proxy)");
  strip->addChild(
      polygon({{206, kY - 1.5F}, {224, kY - 1.5F}, {224, kY + 1.5F}, {206, kY + 1.5F}}, displayed(kArrowColor)));
  strip->addChild(polygon({{223, kY - 6}, {235, kY}, {223, kY + 6}}, displayed(kArrowColor)));
  entry(242, printed("force on finger, 1 N = %.0f mm", 1000 * kArrowLengthPerNewton).c_str());
  const auto wedge = [&](float x, ContactMode mode) {
    strip->addChild(polygon({{x + 7, kY - 8}, {x + 14, kY + 7}, {x, kY + 7}}, displayed(stateColor(mode), 0.9F)));
  };
  wedge(446, ContactMode::kStick);
  wedge(463, ContactMode::kSlip);
  entry(484, "static friction cone: stick, slip");
  strip->addChild(polygon({{701, kY - 6}, {702.2F, kY - 6}, {702.2F, kY + 6}, {701, kY + 6}}, ink_.soft));
  strip->addChild(polygon({{719, kY - 6}, {720.2F, kY - 6}, {720.2F, kY + 6}, {719, kY + 6}}, ink_.soft));
  strip->addChild(polygon({{701, kY - 0.6F}, {720, kY - 0.6F}, {720, kY + 0.6F}, {701, kY + 0.6F}}, ink_.soft));
  entry(727, "grid 5 cm");
  if (interactive) entry(813, "? help");
  message_.emplace(*center_, 0, assembly_ ? AssemblyPanel::kTop + 14 : -kHeight / 2 + 56, 13, ink_.text,
                   Typeface::kRegular, Label::Align::kCenter);
}

void Hud::setHelp(const std::vector<std::pair<std::string, std::string>>& lines) {
  constexpr float kLine = 22;
  const float kHalf = plain_ ? 450 : 290;
  const float top = kLine * static_cast<float>(lines.size()) / 2 + 10;
  center_->removeChild(help_);
  center_->addChild(help_);  // above everything added there meanwhile
  help_->removeChildren(0, help_->getNumChildren());
  help_->addChild(roundedPanel({-kHalf, -top, 2 * kHalf, 2 * top}, 12, {0.04F, 0.06F, 0.09F, 0.9F}));
  float y = top - 25;
  for (const auto& [keys, what] : lines) {
    Label(*help_, keys.empty() ? -kHalf + 24 : -kHalf + 40, y, 14, keys.empty() ? ink_.soft : ink_.text,
          Typeface::kBold)
        .set(keys.empty() ? what : keys);
    if (!keys.empty()) Label(*help_, 0, y, 14, ink_.text).set(what);
    y -= kLine;
  }
}

void Hud::updateCard(Card& card, const FingerView& finger) {
  const osg::Vec4 color = displayed(stateColor(finger.mode));
  card.role.set(finger.role);
  card.state.set(stateWord(finger));
  recolor(*card.lamp, color);
  card.forces.set(printed("normal %5.2f N  tang. %5.2f N", finger.normal_force, finger.tangential_force));
  card.bar.set(finger.frictionUse(), color);
  if (finger.has_volume)  // no common normal, but a torque
    card.use.set(printed("torque %5.3f N m", finger.t_H_W.norm()));
  else if (finger.touches())
    card.use.set(printed("%3.0f %% of \xc2\xb5N, \xc2\xb5 %.2f", 100 * finger.frictionUse(), finger.friction));
  else
    card.use.set("friction used");
}

void Hud::updateRates(const GroupTimings& timings) {
  const bool known = std::any_of(timings.begin(), timings.end(), [](const GroupTiming* timing) { return timing; });
  for (RateLine& line : rates_) {
    const GroupTiming* timing = timings[static_cast<std::size_t>(line.group)];
    // no wall-clock period: a run in virtual time, whose rates are nominal
    const double mean_ns = timing ? timing->period.mean() : 0.0;
    if (mean_ns > 0) {
      line.rate.set(printed("%.0f / %.0f Hz", 1e9 / mean_ns, line.nominal));
      line.missed.set(printed("%llu", static_cast<unsigned long long>(timing->missed + timing->skipped)));
      line.missed.setColor(timing->missed + timing->skipped > 0 ? kAlarm : ink_.text);
    } else {
      line.rate.set(known && !timing ? "not needed" : printed("%.0f Hz", line.nominal));
      line.missed.set("\xe2\x80\x93");
    }
  }
}

void Hud::update(const ViewFrame& frame, const std::vector<FingerView>& fingers, const GroupTimings& timings) {
  time_->set(printed("t = %7.3f s", frame.time));
  for (std::size_t i = 0; i < cards_.size() && i < fingers.size(); ++i) updateCard(cards_[i], fingers[i]);
  if (grip_value_) {
    const double grip = gripForce(fingers);
    grip_value_->set(printed("%.2f of %.0f N", grip, grip_scale_));
    grip_bar_->set(grip / grip_scale_, kGripInk);
  }
  updateRates(timings);
  if (assembly_ && frame.guidance) assembly_->update(world_.scene, *frame.guidance);
  output_->set(outputWords(frame.forces.status));
  // fading at the start and end of every run is normal
  output_->setColor((frame.forces.status & ~kOutputFading) == 0 ? ink_.soft : kAlarm);
}

}  // namespace presa::view
