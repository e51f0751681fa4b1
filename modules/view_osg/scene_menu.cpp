#include "modules/view_osg/scene_menu.h"

#include <algorithm>
#include <osgGA/GUIEventAdapter>

namespace presa::view {
namespace {

using Event = osgGA::GUIEventAdapter;

constexpr float kPanelWidth = 1120, kPanelHeight = 640, kInset = 28;
constexpr float kListTop = kPanelHeight / 2 - 64, kListBottom = -kPanelHeight / 2 + 92, kTallestLine = 22;
constexpr float kColumnWidth = (kPanelWidth - 2 * kInset) / SceneMenu::kColumns;
const osg::Vec4 kPanelColor(0.04F, 0.06F, 0.09F, 0.95F), kMarked(0.2F, 0.45F, 0.75F, 0.9F);

float left(std::size_t column) { return -kPanelWidth / 2 + kInset + kColumnWidth * static_cast<float>(column); }

}  // namespace

SceneMenu::SceneMenu(osg::Group& center, const Ink& ink, std::vector<OfferedScene> scenes, std::size_t now)
    : scenes_(std::move(scenes)), marked_(now), ink_(ink) {
  center.addChild(panel_);
  layOut();
  draw();
  mark(marked_);
  panel_->setNodeMask(0);
}

/// Gives each scene and heading its cell, in as few rows as the columns need.
void SceneMenu::layOut() {
  std::size_t rows = (scenes_.size() + kColumns - 1) / kColumns;
  while (!fits(rows)) ++rows;
  rows_ = rows;
  line_ = std::min(kTallestLine, (kListTop - kListBottom) / static_cast<float>(std::max<std::size_t>(rows_, 1)));
}

// A blank row stands above a heading, and at least one scene below it.
bool SceneMenu::fits(std::size_t rows) {
  cells_.clear();
  headings_.clear();
  Cell next{0, 0};
  const auto down = [&](std::size_t by) { next.row += by; };
  const auto turn = [&](std::size_t needed) {
    if (next.row + needed > rows) next = {next.column + 1, 0};
  };
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    if (i == 0 || scenes_[i].group != scenes_[i - 1].group) {
      turn(next.row > 0 ? 3 : 2);
      if (next.row > 0) down(1);
      headings_.push_back(next);
      down(1);
    } else {
      turn(1);
    }
    cells_.push_back(next);
    down(1);
  }
  return cells_.empty() || (cells_.back().column < kColumns && rows >= 2);
}

void SceneMenu::draw() {
  const float size = 0.66F * line_;
  const auto at = [&](const Cell& cell) { return kListTop - line_ * static_cast<float>(cell.row + 1); };
  panel_->addChild(roundedPanel({-kPanelWidth / 2, -kPanelHeight / 2, kPanelWidth, kPanelHeight}, 14, kPanelColor));
  Label(*panel_, left(0), kPanelHeight / 2 - 42, 22, ink_.text, Typeface::kBold)
      .set("Gallery: " + std::to_string(scenes_.size()) + " scenes");
  bar_->addChild(roundedPanel({-8, -0.28F * line_, kColumnWidth - 12, line_}, 5, kMarked));
  panel_->addChild(bar_);
  auto heading = headings_.begin();
  for (std::size_t i = 0; i < scenes_.size(); ++i) {
    if (i == 0 || scenes_[i].group != scenes_[i - 1].group) {
      Label(*panel_, left(heading->column), at(*heading), size, ink_.soft, Typeface::kBold).set(scenes_[i].group);
      ++heading;
    }
    Label(*panel_, left(cells_[i].column) + 14, at(cells_[i]), size, ink_.text).set(scenes_[i].name);
  }
  sentence_.emplace(*panel_, left(0), -kPanelHeight / 2 + 52, 15, ink_.text);
  Label(*panel_, left(0), -kPanelHeight / 2 + 22, 12.5F, ink_.soft)
      .set(
          "arrows choose      Enter shows the scene      Space gives it to you, with mouse and keys      Esc goes "
          "back");
}

void SceneMenu::mark(std::size_t scene) {
  if (scene >= scenes_.size()) return;
  marked_ = scene;
  const Cell& cell = cells_[scene];
  bar_->setMatrix(osg::Matrixd::translate(left(cell.column), kListTop - line_ * static_cast<float>(cell.row + 1), 0));
  sentence_->set(scenes_[scene].sentence);
}

void SceneMenu::step(int by) {
  const long to = static_cast<long>(marked_) + by;
  mark(static_cast<std::size_t>(std::clamp(to, 0L, static_cast<long>(scenes_.size()) - 1)));
}

/// To the scene of the next column that is nearest to the same row.
void SceneMenu::sideways(int by) {
  const Cell from = cells_[marked_];
  const auto distance = [&](std::size_t scene) {
    return std::abs(static_cast<long>(cells_[scene].row) - static_cast<long>(from.row));
  };
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (static_cast<long>(cells_[i].column) != static_cast<long>(from.column) + by) continue;
    if (!nearest || distance(i) < distance(*nearest)) nearest = i;
  }
  if (nearest) mark(*nearest);
}

void SceneMenu::key(int key) {
  switch (key) {
    case Event::KEY_Up:
      return step(-1);
    case Event::KEY_Down:
      return step(1);
    case Event::KEY_Left:
      return sideways(-1);
    case Event::KEY_Right:
      return sideways(1);
    case Event::KEY_Home:
      return mark(0);
    case Event::KEY_End:
      return mark(scenes_.size() - 1);
    case Event::KEY_Return:
    case Event::KEY_KP_Enter:
    case Event::KEY_Space:
      wish_ = SceneWish{marked_, key == Event::KEY_Space};
      return;
    case Event::KEY_Escape:
    case 'm':
      return toggle();
    default:
      return;
  }
}

void SceneMenu::setAspect(double aspect) {
  const double share = std::min(1.0, (720 * aspect - 20) / kPanelWidth);
  panel_->setMatrix(osg::Matrixd::scale(share, share, 1));
}

}  // namespace presa::view
