#pragma once
#include <array>
#include <cstdio>
#include <osg/Geode>
#include <osg/Geometry>
#include <osgText/Text>
#include <string>

/// Two-dimensional parts of the head-up display, in pixels of a picture 720 lines high, y up. Colours are sRGB.
namespace presa::view {

constexpr float kMargin = 18;                       ///< between panels and the border of the picture
constexpr float kSideWidth = 372, kSideInset = 14;  ///< of the panels on the right: width, and margin of their text

/// printf into a string of at most 159 characters.
template <class... Values>
std::string printed(const char* format, Values... values) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

struct Rect {
  float x, y, width, height;
};

/// DejaVu from Debian's font folder, or OSG's built-in font if it is missing.
enum class Typeface { kRegular, kBold, kMono };
osg::ref_ptr<osgText::Font> loadFont(Typeface typeface);

/// A line of text. `align`: the end that is fixed at (x, y); y is the base line.
class Label {
 public:
  enum class Align { kLeft, kRight, kCenter };
  Label(osg::Group& parent, float x, float y, float size, const osg::Vec4& color,
        Typeface typeface = Typeface::kRegular, Align align = Align::kLeft);
  void set(const std::string& utf8);
  void setColor(const osg::Vec4& color) { text_->setColor(color); }

 private:
  osg::ref_ptr<osgText::Text> text_ = new osgText::Text;
  std::string shown_;
};

/// Filled polygon with one colour (convex, in order).
osg::ref_ptr<osg::Geometry> polygon(const std::vector<osg::Vec2>& corners, const osg::Vec4& color);
osg::ref_ptr<osg::Geometry> roundedPanel(const Rect& rect, float corner, const osg::Vec4& color);
osg::ref_ptr<osg::Geometry> dot(float x, float y, float radius, const osg::Vec4& color);
void recolor(osg::Geometry& geometry, const osg::Vec4& color);

/// A bar for a value between 0 and 1, filled from the left.
class Bar {
 public:
  Bar(osg::Group& parent, const Rect& rect, const osg::Vec4& track = {1, 1, 1, 0.16F});
  void set(double share, const osg::Vec4& color);

 private:
  Rect rect_;
  osg::ref_ptr<osg::Geometry> fill_;
};

}  // namespace presa::view
