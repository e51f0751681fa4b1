#include "modules/view_osg/body_card.h"
#include "modules/view_osg/hud_widgets.h"

#include <cstdio>
#include <numbers>

namespace presa::view {
namespace {

constexpr float kBodyCardWidth = 268, kBodyCardHeight = 92, kBodyCardBottom = 126;
const osg::Vec4 kBodyCardPanel(0.05F, 0.07F, 0.10F, 0.74F), kBodyCardInk(0.95F, 0.96F, 0.98F, 1),
    kBodyCardSoftInk(0.66F, 0.70F, 0.75F, 1);

}  // namespace

BodyCard::BodyCard(osg::Group& right, const World& world) : world_(world) {
  const float left = -kMargin - kBodyCardWidth, text = left + 12;
  right.addChild(card_);
  card_->setNodeMask(0);
  card_->addChild(roundedPanel({left, kBodyCardBottom, kBodyCardWidth, kBodyCardHeight}, 8, kBodyCardPanel));
  name_.emplace(*card_, text, kBodyCardBottom + 70, 15, kBodyCardInk, Typeface::kBold);
  what_.emplace(*card_, text, kBodyCardBottom + 50, 13, kBodyCardSoftInk);
  place_.emplace(*card_, text, kBodyCardBottom + 31, 12, kBodyCardInk, Typeface::kMono);
  turn_.emplace(*card_, text, kBodyCardBottom + 13, 12, kBodyCardInk, Typeface::kMono);
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
    what_->set(printed("%.4g kg, ", world_.inertias[*body].mass) + material);
}

void BodyCard::update(const std::vector<Pose>& X_WB) {
  if (!body_ || *body_ >= X_WB.size()) return;
  const Pose& pose = X_WB[*body_];
  place_->set(printed("%+.4f %+.4f %+.4f m", pose.p.x(), pose.p.y(), pose.p.z()));
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(pose.q).normalized());
  turn_->set(printed("%5.1f\xc2\xb0 about %+.2f %+.2f %+.2f", turn.angle() * 180 / std::numbers::pi, turn.axis().x(),
                     turn.axis().y(), turn.axis().z()));
}

}  // namespace presa::view
