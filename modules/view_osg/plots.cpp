#include "modules/view_osg/plots.h"

#include <algorithm>
#include <cstdio>

namespace presa::view {
namespace {

constexpr float kWidth = 262, kHeight = 84, kPitch = 90, kMargin = 18, kBottom = 126, kInset = 12, kCurveHeight = 50;
const osg::Vec4 kPanel(0.05F, 0.07F, 0.10F, 0.74F), kInk(0.95F, 0.96F, 0.98F, 1);
const std::array<osg::Vec4, 4> kCurves{osg::Vec4(0.35F, 0.85F, 1.0F, 1), osg::Vec4(1.0F, 0.66F, 0.2F, 1),
                                       osg::Vec4(0.6F, 0.95F, 0.5F, 1), osg::Vec4(0.95F, 0.5F, 0.85F, 1)};
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

}  // namespace

Plots::Plots(osg::Group& left, const World& world)
    : fingers_(world.scene.devices.size()), nominal_rate_(world.scene.rates.haptic) {
  left.addChild(group_);
  group_->setNodeMask(0);
  for (std::size_t q = 0; q < kQuantities; ++q) {
    const float bottom = kBottom + kPitch * static_cast<float>(kQuantities - 1 - q);
    group_->addChild(roundedPanel({kMargin, bottom, kWidth, kHeight}, 8, kPanel));
    Panel panel{Label(*group_, kMargin + kInset, bottom + kHeight - 18, 13, kInk, Typeface::kBold), {}};
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
  static constexpr std::array<const char*, kQuantities> kNames{"normal force", "penetration", "haptic rate"};
  static constexpr std::array<const char*, kQuantities> kUnits{"N", "mm", "Hz"};
  const double min_top = quantity == kForce ? 1 : quantity == kDepth ? 1 : nominal_rate_;
  double top = min_top;
  for (const Moment& moment : moments_) {
    for (std::size_t f = 0; f < panels_[quantity].curves.size(); ++f) top = std::max(top, moment.values[quantity][f]);
  }
  std::array<char, 80> title;
  std::snprintf(title.data(), title.size(), "%s, 0 to %.3g %s", kNames[quantity], top, kUnits[quantity]);
  panels_[quantity].title.set(title.data());
  const float bottom = kBottom + kPitch * static_cast<float>(kQuantities - 1 - quantity) + 8;
  const double begin = moments_.back().time - kSeconds;
  for (std::size_t f = 0; f < panels_[quantity].curves.size(); ++f) {
    osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
    for (const Moment& moment : moments_) {
      const auto along = static_cast<float>((moment.time - begin) / kSeconds);
      const auto up = static_cast<float>(std::max(0.0, moment.values[quantity][f]) / top);
      points->push_back({kMargin + kInset + (kWidth - 2 * kInset) * along, bottom + kCurveHeight * up, 0});
    }
    osg::Geometry& line = *panels_[quantity].curves[f];
    line.setVertexArray(points);
    line.removePrimitiveSet(0, line.getNumPrimitiveSets());
    line.addPrimitiveSet(new osg::DrawArrays(GL_LINE_STRIP, 0, static_cast<GLsizei>(points->size())));
    line.dirtyBound();
  }
}

}  // namespace presa::view
