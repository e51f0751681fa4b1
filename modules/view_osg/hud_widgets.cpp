#include "modules/view_osg/hud_widgets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <osgText/Font>

namespace presa::view {
namespace {

/// Size from which text needs finer glyphs [line]; those of smaller text are 1.7 to 2.8 times as fine as a window of
/// 720 lines shows them.
constexpr float kLargeText = 19;

}  // namespace

osg::ref_ptr<osgText::Font> loadFont(Typeface typeface) {
  static const std::string folder = "/usr/share/fonts/truetype/dejavu/";
  const char* file = typeface == Typeface::kBold   ? "DejaVuSans-Bold.ttf"
                     : typeface == Typeface::kMono ? "DejaVuSansMono.ttf"
                                                   : "DejaVuSans.ttf";
  osg::ref_ptr<osgText::Font> font;
  if (std::filesystem::exists(folder + file)) font = osgText::readRefFontFile(folder + file);
  // Without mipmaps, which Mesa draws with programs that it compiles in each process: 0.1 s until the first picture.
  if (font) font->setMinFilterHint(osg::Texture::LINEAR);
  return font ? font : osgText::Font::getDefaultFont();
}

Label::Label(osg::Group& parent, float x, float y, float size, const osg::Vec4& color, Typeface typeface, Align align) {
  text_->setDataVariance(osg::Object::DYNAMIC);
  text_->setFont(loadFont(typeface));
  const unsigned pixels = size < kLargeText ? 32 : 48;
  text_->setFontResolution(pixels, pixels);
  text_->setCharacterSize(size);
  text_->setPosition({x, y, 0});
  text_->setColor(color);
  text_->setAlignment(align == Align::kLeft    ? osgText::Text::LEFT_BASE_LINE
                      : align == Align::kRight ? osgText::Text::RIGHT_BASE_LINE
                                               : osgText::Text::CENTER_BASE_LINE);
  parent.addChild(text_);
}

void Label::set(const std::string& utf8) {
  if (utf8 == shown_) return;  // text layout is expensive
  shown_ = utf8;
  text_->setText(utf8, osgText::String::ENCODING_UTF8);
}

osg::ref_ptr<osg::Geometry> polygon(const std::vector<osg::Vec2>& corners, const osg::Vec4& color) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setDataVariance(osg::Object::DYNAMIC);
  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  for (const osg::Vec2& corner : corners) positions->push_back(osg::Vec3(corner, 0));
  geometry->setVertexArray(positions);
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
  colors->push_back(color);
  geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, static_cast<int>(positions->size())));
  return geometry;
}

osg::ref_ptr<osg::Geometry> roundedPanel(const Rect& rect, float corner, const osg::Vec4& color) {
  constexpr int kSteps = 6;
  const float right = rect.x + rect.width - corner, top = rect.y + rect.height - corner;
  const osg::Vec2 centers[4] = {
      {right, top}, {rect.x + corner, top}, {rect.x + corner, rect.y + corner}, {right, rect.y + corner}};
  std::vector<osg::Vec2> corners;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int i = 0; i <= kSteps; ++i) {
      const float angle =
          std::numbers::pi_v<float> / 2 * (static_cast<float>(quarter) + static_cast<float>(i) / kSteps);
      corners.push_back(centers[quarter] + osg::Vec2(std::cos(angle), std::sin(angle)) * corner);
    }
  }
  return polygon(corners, color);
}

osg::ref_ptr<osg::Geometry> dot(float x, float y, float radius, const osg::Vec4& color) {
  return roundedPanel({x - radius, y - radius, 2 * radius, 2 * radius}, radius, color);
}

void recolor(osg::Geometry& geometry, const osg::Vec4& color) {
  auto& colors = static_cast<osg::Vec4Array&>(*geometry.getColorArray());
  if (colors[0] == color) return;
  colors[0] = color;
  colors.dirty();
}

Bar::Bar(osg::Group& parent, const Rect& rect, const osg::Vec4& track) : rect_(rect) {
  parent.addChild(roundedPanel(rect, rect.height / 2, track));
  fill_ = roundedPanel(rect, rect.height / 2, {1, 1, 1, 1});
  parent.addChild(fill_);
}

void Bar::set(double share, const osg::Vec4& color) {
  const auto filled = static_cast<float>(std::clamp(share, 0.0, 1.0)) * rect_.width;
  fill_->setNodeMask(filled > 0.5F ? ~0U : 0U);
  const osg::ref_ptr<osg::Geometry> shape =
      roundedPanel({rect_.x, rect_.y, filled, rect_.height}, std::min(rect_.height, filled) / 2, color);
  fill_->setVertexArray(shape->getVertexArray());
  fill_->dirtyBound();
  recolor(*fill_, color);
}

}  // namespace presa::view
