#include "modules/view_osg/show_how.h"

#include <cmath>
#include <numbers>

namespace presa::view {
namespace {

const osg::Vec4 kHowInk(0.97F, 0.96F, 0.93F, 1), kHowPanel(0.06F, 0.055F, 0.05F, 0.82F);
const osg::Vec4 kMouse(0.90F, 0.90F, 0.88F, 1), kSeam(0.45F, 0.45F, 0.46F, 1), kPressed(1.0F, 0.72F, 0.16F, 1);
const osg::Vec4 kHandSkin(0.93F, 0.72F, 0.57F, 1), kNail(0.98F, 0.86F, 0.78F, 1), kKey(0.93F, 0.93F, 0.95F, 1);
const osg::Vec4 kKeyInk(0.12F, 0.12F, 0.14F, 1);
constexpr float kHowLeft = 18, kHowBottom = 532, kHowWidth = 440, kHowHeight = 170;  // of the panel
constexpr float kIcon = kHowLeft + kHowWidth / 2, kMiddle = kHowBottom + 112;        // middle of the mouse
constexpr double kPeriod = 1.8;                                                      // of the animation [s]
constexpr float kSwing = 26, kRoll = 9;                                              // [lines]

osg::ref_ptr<osg::Geometry> arrow(float x, float y, float dx, float dy) {
  const osg::Vec2 tip(x + dx, y + dy), across(-dy * 0.6F, dx * 0.6F);
  return polygon({osg::Vec2(x, y) + across, osg::Vec2(x, y) - across, tip}, kPressed);
}

osg::ref_ptr<osg::Group> keyCap(const std::string& text, float x, float y, float width) {
  osg::ref_ptr<osg::Group> cap = new osg::Group;
  cap->addChild(roundedPanel({x - width / 2, y - 17, width, 34}, 6, kSeam));
  cap->addChild(roundedPanel({x - width / 2 + 2, y - 13, width - 4, 29}, 5, kKey));
  Label label(*cap, x, y - 5, 16, kKeyInk, Typeface::kBold, Label::Align::kCenter);
  label.set(text);
  return cap;
}

void shown(osg::Node& node, bool is) { node.setNodeMask(is ? ~0U : 0U); }

}  // namespace

ShowHow::ShowHow(osg::Group& parent, const Scene& scene) : scene_(scene) {
  root_->setName("show how");
  parent.addChild(root_);
  root_->addChild(roundedPanel({kHowLeft, kHowBottom, kHowWidth, kHowHeight}, 14, kHowPanel));
  for (osg::Group* part : {arrows_.get(), shift_.get(), turn_keys_.get()}) root_->addChild(part);
  root_->addChild(mouse_);
  addMouse();
  addKeys();
  does_.emplace(*root_, kIcon, kHowBottom + 36, 20, kHowInk, Typeface::kBold, Label::Align::kCenter);
  keys_.emplace(*root_, kIcon, kHowBottom + 13, 16, kPressed, Typeface::kRegular, Label::Align::kCenter);
  shown(*root_, false);
}

// Seen from above: the mouse, and the hand with its index finger on the left button or on the wheel.
void ShowHow::addMouse() {
  mouse_->setDataVariance(osg::Object::DYNAMIC);
  finger_->setDataVariance(osg::Object::DYNAMIC);
  mouse_->addChild(roundedPanel({-21, -34, 42, 68}, 20, kSeam));
  mouse_->addChild(roundedPanel({-19, -32, 38, 64}, 18, kMouse));
  button_ = polygon({{-18, 6}, {-2, 6}, {-2, 30}, {-9, 28}, {-16, 20}}, kPressed);
  mouse_->addChild(button_);
  mouse_->addChild(polygon({{-19, 4}, {19, 4}, {19, 6}, {-19, 6}}, kSeam));
  mouse_->addChild(polygon({{-1, 6}, {1, 6}, {1, 31}, {-1, 31}}, kSeam));
  wheel_ = roundedPanel({-4, 11, 8, 17}, 4, kSeam);
  mouse_->addChild(wheel_);
  // the palm, three fingers beside the mouse, and the index finger
  mouse_->addChild(roundedPanel({-24, -56, 50, 46}, 20, kHandSkin));
  mouse_->addChild(roundedPanel({-31, -34, 12, 36}, 6, kHandSkin));
  mouse_->addChild(roundedPanel({13, -30, 12, 46}, 6, kHandSkin));
  mouse_->addChild(finger_);
  finger_->addChild(roundedPanel({-6, -28, 12, 48}, 6, kHandSkin));
  finger_->addChild(roundedPanel({-3.5F, 10, 7, 8}, 3, kNail));
}

void ShowHow::addKeys() {
  for (const float side : {-1.0F, 1.0F}) arrows_->addChild(arrow(kIcon + side * 62, kMiddle, side * 14, 0));
  shift_->addChild(keyCap("\xe2\x87\xa7", kIcon - 84, kMiddle - 20, 44));
  for (const float side : {-1.0F, 1.0F}) shift_->addChild(arrow(kIcon + 62, kMiddle + side * 14, 0, side * 14));
  turn_keys_->addChild(keyCap("E", kIcon + 32, kMiddle, 42));
  turn_keys_->addChild(key_);
  key_->setDataVariance(osg::Object::DYNAMIC);
  key_->addChild(keyCap("Q", kIcon - 32, kMiddle, 42));
}

void ShowHow::animate(double time) {
  const auto wave = static_cast<float>(std::sin(2 * std::numbers::pi * time / kPeriod));
  const Lesson::Step step = lesson_.step();
  const bool drag = step == Lesson::Step::kDrag, lift = step == Lesson::Step::kLift;
  const bool pinch = step == Lesson::Step::kPinch, turn = step == Lesson::Step::kTurn;
  shown(*mouse_, !turn);
  shown(*turn_keys_, turn);
  shown(*shift_, lift);
  shown(*arrows_, drag);
  shown(*button_, drag || lift);
  recolor(*wheel_, pinch ? kPressed : kSeam);
  mouse_->setMatrix(
      osg::Matrixd::translate(kIcon + (drag ? kSwing * wave : 0), kMiddle + 8 + (lift ? 14 * wave : 0), 0));
  // on the wheel the finger rolls forwards again and again, on the button it lies still
  const double turned = std::fmod(time, kPeriod / 2) / (kPeriod / 2);
  finger_->setMatrix(osg::Matrixd::translate(pinch ? 0 : -10, pinch ? kRoll * (turned - 0.5) : 0, 0));
  key_->setMatrix(osg::Matrixd::translate(0, wave > 0 ? -3 : 0, 0));
}

void ShowHow::update(const ViewFrame& frame, const std::vector<FingerView>& fingers) {
  lesson_.update(frame, fingers);
  const AssemblyWords::Action* action = lesson_.action(scene_.assembly->words);
  shown(*root_, action != nullptr);
  if (action == nullptr) return;
  does_->set(action->does);
  keys_->set(action->keys);
  animate(frame.time);
}

}  // namespace presa::view
