#include "modules/view_osg/assembly_panel.h"

namespace presa::view {
namespace {

const osg::Vec4 kInk(0.97F, 0.96F, 0.93F, 1);
const osg::Vec4 kSoftInk(0.97F, 0.96F, 0.93F, 0.86F);
const osg::Vec4 kPanel(0.06F, 0.055F, 0.05F, 0.78F);
const osg::Vec4 kDone(0.56F, 0.88F, 0.52F, 1);
const osg::Vec4 kAdvice(1.0F, 0.80F, 0.32F, 1);
constexpr float kWidth = 900, kBottom = -350, kInset = 26;

}  // namespace

AssemblyPanel::AssemblyPanel(osg::Group& center) {
  constexpr float kLeft = -kWidth / 2 + kInset;
  center.addChild(roundedPanel({-150, 304, 300, 46}, 12, kPanel));
  progress_.emplace(center, 0, 328, 17, kInk, Typeface::kRegular, Label::Align::kCenter);
  bar_.emplace(center, Rect{-130, 312, 260, 8});

  center.addChild(lines_);
  lines_->addChild(roundedPanel({-kWidth / 2, kBottom, kWidth, kTop - kBottom}, 12, kPanel));
  title_.emplace(*lines_, kLeft, kTop - 32, 24, kInk, Typeface::kBold);
  sentence_.emplace(*lines_, kLeft, kTop - 57, 16, kSoftInk);
  advice_.emplace(*lines_, kLeft, kBottom + 15, 18, kAdvice, Typeface::kBold);

  center.addChild(finish_group_);
  finish_group_->addChild(roundedPanel({-330, kBottom, 660, kTop - kBottom}, 14, kPanel));
  finish_.emplace(*finish_group_, 0, kTop - 52, 42, kInk, Typeface::kBold, Label::Align::kCenter);
  took_.emplace(*finish_group_, 0, kBottom + 18, 21, kSoftInk, Typeface::kRegular, Label::Align::kCenter);
}

void AssemblyPanel::update(const Scene& scene, const Guidance& guidance) {
  const Captions captions = captionsOf(scene, guidance);
  const double share = guidance.all > 0 ? static_cast<double>(guidance.placed) / guidance.all : 0;
  bar_->set(share, kDone);
  showLines(captions);
}

void AssemblyPanel::showLines(const Captions& captions) {
  progress_->set(captions.progress);
  const bool news = !captions.news.empty();
  title_->set(news ? captions.news : captions.title);
  title_->setColor(captions.good ? kDone : news ? kAdvice : kInk);
  sentence_->set(captions.sentence);
  advice_->set(captions.reason.empty() ? captions.hint : captions.reason);
  finish_->set(captions.finish);
  took_->set(captions.took);
  finish_group_->setNodeMask(captions.finish.empty() ? 0U : ~0U);
  const bool advice = !captions.reason.empty() || !captions.hint.empty();
  lines_->setNodeMask(captions.finish.empty() && (news || advice || !captions.title.empty()) ? ~0U : 0U);
}

}  // namespace presa::view
