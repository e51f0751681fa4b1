#include "modules/view_osg/assembly_panel.h"

namespace presa::view {
namespace {

const osg::Vec4 kWordsInk(0.97F, 0.96F, 0.93F, 1);
const osg::Vec4 kWordsSoftInk(0.97F, 0.96F, 0.93F, 0.86F);
const osg::Vec4 kWordsPanel(0.06F, 0.055F, 0.05F, 0.78F);
const osg::Vec4 kDone(0.56F, 0.88F, 0.52F, 1);
const osg::Vec4 kAdvice(1.0F, 0.80F, 0.32F, 1);
constexpr float kWordsWidth = 900, kWordsBottom = -350, kWordsInset = 26;

}  // namespace

AssemblyPanel::AssemblyPanel(osg::Group& center) {
  constexpr float kWordsLeft = -kWordsWidth / 2 + kWordsInset;
  center.addChild(roundedPanel({-150, 304, 300, 46}, 12, kWordsPanel));
  progress_.emplace(center, 0, 328, 17, kWordsInk, Typeface::kRegular, Label::Align::kCenter);
  bar_.emplace(center, Rect{-130, 312, 260, 8});

  center.addChild(lines_);
  lines_->addChild(roundedPanel({-kWordsWidth / 2, kWordsBottom, kWordsWidth, kTop - kWordsBottom}, 12, kWordsPanel));
  title_.emplace(*lines_, kWordsLeft, kTop - 32, 24, kWordsInk, Typeface::kBold);
  sentence_.emplace(*lines_, kWordsLeft, kTop - 57, 16, kWordsSoftInk);
  advice_.emplace(*lines_, kWordsLeft, kWordsBottom + 15, 18, kAdvice, Typeface::kBold);

  center.addChild(finish_group_);
  finish_group_->addChild(roundedPanel({-330, kWordsBottom, 660, kTop - kWordsBottom}, 14, kWordsPanel));
  finish_.emplace(*finish_group_, 0, kTop - 52, 42, kWordsInk, Typeface::kBold, Label::Align::kCenter);
  took_.emplace(*finish_group_, 0, kWordsBottom + 18, 21, kWordsSoftInk, Typeface::kRegular, Label::Align::kCenter);
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
  title_->setColor(captions.good ? kDone : news ? kAdvice : kWordsInk);
  sentence_->set(captions.sentence);
  advice_->set(captions.reason.empty() ? captions.hint : captions.reason);
  finish_->set(captions.finish);
  took_->set(captions.took);
  finish_group_->setNodeMask(captions.finish.empty() ? 0U : ~0U);
  const bool advice = !captions.reason.empty() || !captions.hint.empty();
  lines_->setNodeMask(captions.finish.empty() && (news || advice || !captions.title.empty()) ? ~0U : 0U);
}

}  // namespace presa::view
