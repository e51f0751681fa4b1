#include "modules/view_osg/plots.h"
#include "modules/view_osg/hud_widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace presa::view {
namespace {

constexpr float kPlotWidth = 262, kPlotHeight = 84, kPlotPitch = 90, kPlotBottom = 126, kPlotInset = 12,
                kCurveHeight = 46;
constexpr float kNumbers = 36;  // for the numbers of an axis
constexpr float kPlotLeft = kMargin + kPlotInset + kNumbers,
                kPlotRight = kMargin + kPlotWidth - kPlotInset;  // of the curves
constexpr float kCurveBottom = 10;                               // above the lower edge of a panel
const osg::Vec4 kPlotPanel(0.05F, 0.07F, 0.10F, 0.74F), kPlotInk(0.95F, 0.96F, 0.98F, 1),
    kPlotAxis(0.55F, 0.59F, 0.65F, 1);
const std::array<osg::Vec4, 4> kCurves{osg::Vec4(0.35F, 0.85F, 1.0F, 1), osg::Vec4(1.0F, 0.66F, 0.2F, 1),
                                       osg::Vec4(0.6F, 0.95F, 0.5F, 1), osg::Vec4(0.95F, 0.5F, 0.85F, 1)};
constexpr std::array<const char*, 3> kTitles{"normal force [N], last 5 s", "penetration [mm], last 5 s",
                                             "haptic rate [Hz], last 5 s"};
constexpr double kCountTime = 0.25;  ///< interval over which ticks are counted [s]

osg::ref_ptr<osg::Geometry> curve(const osg::Vec4& color) {
  osg::ref_ptr<osg::Geometry> line = new osg::Geometry;
  line->setDataVariance(osg::Object::DYNAMIC);
  line->setUseDisplayList(false);
  line->setUseVertexBufferObjects(true);
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_OVERALL);
  colors->push_back(color);
  line->setColorArray(colors);
  return line;
}

/// The axis and the line of its upper end, one unit thick.
osg::ref_ptr<osg::Geometry> line(float x, float y, float width, float height) {
  return polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, kPlotAxis);
}

/// The smallest of 1, 2 and 5 times a power of ten that is not below the value: the axis seldom changes.
double roundedUp(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (value <= factor * power * (1 + 1e-9)) return factor * power;
  return 10 * power;
}

std::string numberText(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

}  // namespace

Plots::Plots(osg::Group& left, const World& world)
    : fingers_(world.scene.devices.size()), nominal_rate_(world.scene.rates.haptic) {
  left.addChild(group_);
  group_->setNodeMask(0);
  for (std::size_t q = 0; q < kQuantities; ++q) {
    const float bottom = kPlotBottom + kPlotPitch * static_cast<float>(kQuantities - 1 - q);
    group_->addChild(roundedPanel({kMargin, bottom, kPlotWidth, kPlotHeight}, 8, kPlotPanel));
    const float zero = bottom + kCurveBottom, numbers = kPlotLeft - 6;
    group_->addChild(line(kPlotLeft, zero, kPlotRight - kPlotLeft, 1));
    group_->addChild(line(kPlotLeft, zero, 1, kCurveHeight));
    group_->addChild(line(kPlotLeft - 3, zero + kCurveHeight, 3, 1));
    Panel panel{
        Label(*group_, kMargin + kPlotInset, bottom + kPlotHeight - 18, 13, kPlotInk, Typeface::kBold),
        Label(*group_, numbers, zero + kCurveHeight - 4, 11, kPlotInk, Typeface::kRegular, Label::Align::kRight),
        {}};
    Label(*group_, numbers, zero - 4, 11, kPlotInk, Typeface::kRegular, Label::Align::kRight).set("0");
    panel.title.set(kTitles[q]);
    for (std::size_t f = 0; f < (q == kRate ? 1 : fingers_); ++f) {
      panel.curves.push_back(curve(kCurves[f % kCurves.size()]));
      group_->addChild(panel.curves.back());
    }
    panels_.push_back(std::move(panel));
  }
}

// In virtual time every tick is on time: the rate is the nominal one.
double Plots::haptic(const GroupTimings& timings) {
  const GroupTiming* timing = timings[static_cast<std::size_t>(RateGroup::kHaptic)];
  if (timing == nullptr || !(timing->period.mean() > 0)) return nominal_rate_;
  const std::uint64_t ticks = timing->ticks;
  const osg::Timer_t now = osg::Timer::instance()->tick();
  const double seconds = osg::Timer::instance()->delta_s(counted_, now);
  if (counted_ != 0 && seconds < kCountTime) return rate_;
  rate_ = counted_ == 0 ? nominal_rate_ : static_cast<double>(ticks - ticks_) / seconds;
  ticks_ = ticks, counted_ = now;
  return rate_;
}

void Plots::add(const ViewFrame& frame, const GroupTimings& timings) {
  if (!moments_.empty() && frame.time < moments_.back().time) moments_.clear();
  Moment moment{frame.time, {}};
  moment.values[kForce].resize(fingers_);
  moment.values[kDepth].resize(fingers_);
  for (std::size_t f = 0; f < std::min(fingers_, frame.contacts.fingers.size()); ++f) {
    const FingerContact& contact = frame.contacts.fingers[f];
    const bool touches = contact.mode != ContactMode::kNone;
    moment.values[kForce][f] = touches ? contact.normal_force : 0;
    moment.values[kDepth][f] = touches ? 1e3 * contact.depth : 0;
  }
  moment.values[kRate] = {haptic(timings)};
  moments_.push_back(std::move(moment));
  while (moments_.front().time < frame.time - kSeconds) moments_.pop_front();
}

void Plots::update(bool shown) {
  group_->setNodeMask(shown ? ~0U : 0U);
  if (!shown || moments_.empty()) return;
  for (const Quantity quantity : {kForce, kDepth, kRate}) draw(quantity);
}

void Plots::draw(Quantity quantity) {
  const double min_top = quantity == kRate ? 1.1 * nominal_rate_ : 1;  // the rate wavers about the nominal one
  double top = min_top;
  for (const Moment& moment : moments_) {
    for (std::size_t f = 0; f < panels_[quantity].curves.size(); ++f) top = std::max(top, moment.values[quantity][f]);
  }
  top = roundedUp(top);
  panels_[quantity].top.set(numberText(top));
  const float bottom = kPlotBottom + kPlotPitch * static_cast<float>(kQuantities - 1 - quantity) + kCurveBottom;
  const double begin = moments_.back().time - kSeconds;
  for (std::size_t f = 0; f < panels_[quantity].curves.size(); ++f) {
    osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
    for (const Moment& moment : moments_) {
      const auto along = static_cast<float>((moment.time - begin) / kSeconds);
      const auto up = static_cast<float>(std::max(0.0, moment.values[quantity][f]) / top);
      points->push_back({kPlotLeft + (kPlotRight - kPlotLeft) * along, bottom + kCurveHeight * up, 0});
    }
    osg::Geometry& line = *panels_[quantity].curves[f];
    line.setVertexArray(points);
    line.removePrimitiveSet(0, line.getNumPrimitiveSets());
    line.addPrimitiveSet(new osg::DrawArrays(GL_LINE_STRIP, 0, static_cast<GLsizei>(points->size())));
    line.dirtyBound();
  }
}

}  // namespace presa::view
