#include "modules/view_osg/body_card.h"

#include <cstdio>
#include <numbers>

namespace presa::view {
namespace {

constexpr float kWidth = 268, kHeight = 92, kMargin = 18, kBottom = 126;
const osg::Vec4 kPanel(0.05F, 0.07F, 0.10F, 0.74F), kInk(0.95F, 0.96F, 0.98F, 1), kSoftInk(0.66F, 0.70F, 0.75F, 1);

template <class... Args>
std::string print(const char* format, Args... args) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), format, args...);
  return text.data();
}

}  // namespace

BodyCard::BodyCard(osg::Group& right, const World& world) : world_(world) {
  const float left = -kMargin - kWidth, text = left + 12;
  right.addChild(card_);
  card_->setNodeMask(0);
  card_->addChild(roundedPanel({left, kBottom, kWidth, kHeight}, 8, kPanel));
  name_.emplace(*card_, text, kBottom + 70, 15, kInk, Typeface::kBold);
  what_.emplace(*card_, text, kBottom + 50, 13, kSoftInk);
  place_.emplace(*card_, text, kBottom + 31, 12, kInk, Typeface::kMono);
  turn_.emplace(*card_, text, kBottom + 13, 12, kInk, Typeface::kMono);
}

void BodyCard::choose(std::optional<std::size_t> body) {
  body_ = body;
  card_->setNodeMask(body ? ~0U : 0U);
  if (!body) return;
  const Body& chosen = world_.scene.bodies[*body];
  const std::string material = world_.scene.materialOf(chosen).name;
  name_->set(chosen.name);
  if (chosen.fixed || *body >= world_.inertias.size())
    what_->set((chosen.fixed ? "fixed, " : "") + material);
  else
    what_->set(print("%.4g kg, ", world_.inertias[*body].mass) + material);
}

void BodyCard::update(const std::vector<Pose>& X_WB) {
  if (!body_ || *body_ >= X_WB.size()) return;
  const Pose& pose = X_WB[*body_];
  place_->set(print("%+.4f %+.4f %+.4f m", pose.p.x(), pose.p.y(), pose.p.z()));
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(pose.q).normalized());
  turn_->set(print("%5.1f\xc2\xb0 about %+.2f %+.2f %+.2f", turn.angle() * 180 / std::numbers::pi, turn.axis().x(),
                   turn.axis().y(), turn.axis().z()));
}

}  // namespace presa::view
