#include "modules/view_osg/participant_panel.h"

#include <algorithm>
#include <utility>

namespace presa::view {
namespace {

const osg::Vec4 kText(0.95F, 0.97F, 1.0F, 1), kCard(0.04F, 0.06F, 0.09F, 0.72F), kNight(0, 0, 0, 1);
constexpr float kFarOut = 4000;  // beyond the edges of any picture
constexpr float kTextSize = 24, kTextLine = 34, kCardWide = 860;
constexpr float kCardBottom = -330;  // of the card, 30 above the lower edge
constexpr float kCrossArm = 16, kCrossThick = 3;
constexpr std::size_t kColumns = 64, kMaxLines = 4;

osg::ref_ptr<osg::Geometry> filled(const Rect& r, const osg::Vec4& color) {
  return polygon({{r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}}, color);
}

void setSeen(osg::Node& node, bool shown) { node.setNodeMask(shown ? ~0U : 0U); }

std::size_t charactersOf(const std::string& utf8) {
  return static_cast<std::size_t>(
      std::ranges::count_if(utf8, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
  std::vector<std::string> lines;
  if (const std::size_t end = text.find('\n'); end != std::string::npos) {
    lines = wrapped(text.substr(0, end), columns);
    for (std::string& line : wrapped(text.substr(end + 1), columns)) lines.push_back(std::move(line));
    return lines;
  }
  std::string line;
  for (std::size_t begin = text.find_first_not_of(' '); begin != std::string::npos;) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && charactersOf(line) + 1 + charactersOf(word) > columns)
      lines.push_back(std::exchange(line, ""));
    line += (line.empty() ? "" : " ") + word;
    begin = text.find_first_not_of(' ', end);
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

ParticipantPanel::ParticipantPanel(osg::Group& center) {
  ground_->addChild(filled({-kFarOut, -kFarOut, 2 * kFarOut, 2 * kFarOut}, kNight));
  cross_->addChild(filled({-kCrossArm, -kCrossThick / 2, 2 * kCrossArm, kCrossThick}, kText));
  cross_->addChild(filled({-kCrossThick / 2, -kCrossArm, kCrossThick, 2 * kCrossArm}, kText));
  for (const auto& part : {ground_, cross_, card_}) center.addChild(part);
  for (std::size_t i = 0; i < kMaxLines; ++i)
    lines_.emplace_back(center, 0, kCardBottom + 14 + kTextLine * static_cast<float>(kMaxLines - 1 - i), kTextSize,
                        kText, Typeface::kRegular, Label::Align::kCenter);
  show({});
}

void ParticipantPanel::show(const ParticipantScreen& screen) {
  setSeen(*ground_, !screen.bodies && !screen.fingertips);
  setSeen(*cross_, screen.fixation);
  std::vector<std::string> lines = wrapped(screen.text, kColumns);
  if (lines.size() > kMaxLines) lines.resize(kMaxLines);
  card_->removeChildren(0, card_->getNumChildren());
  const float height = kTextLine * static_cast<float>(lines.size()) + 14;
  if (!lines.empty()) card_->addChild(roundedPanel({-kCardWide / 2, kCardBottom, kCardWide, height}, 10, kCard));
  const std::size_t empty = kMaxLines - lines.size();  // above the text
  for (std::size_t i = 0; i < kMaxLines; ++i) lines_[i].set(i < empty ? "" : lines[i - empty]);
}

}  // namespace presa::view
