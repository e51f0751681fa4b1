#pragma once
#include <string>
#include <vector>

#include "apps/common/report/svg_plot.h"

/// Symbols and direct labels that several kinds of plot share.
namespace presa::svg {

/// Circle, square, triangle, diamond, down triangle, cross: distinguishable without colour.
std::string symbolPath(double x, double y, double r, int shape);

/// "s0" … "s5", from kRamp on "r0" … "r11"; below 0: "ink".
std::string colorClass(int color);

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool meets(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool holds(const Box& other) const {
    return left <= other.left && other.right <= right && top <= other.top && other.bottom <= bottom;
  }
};

/// A label wanted beside a point [px].
struct PointLabel {
  Point at;
  std::string text;
  bool needed = false;  ///< drawn even where it covers something
};
/// Draws labels, the first ones first, inside `area` and clear of `taken` and of each other; far ones with a line to
/// their point. A label without room is left out, unless it is needed.
std::string pointLabels(const std::vector<PointLabel>& labels, const Box& area, std::vector<Box> taken);

/// Estimated width of a text of the page's plots [px].
double textWidth(const std::string& text);

}  // namespace presa::svg
