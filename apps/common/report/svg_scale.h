#pragma once
#include <string>

#include "apps/common/number_text.h"

namespace presa::svg {

/// Linear map from data to pixels.
struct Scale {
  double data_low = 0, data_high = 1;
  double pixel_low = 0, pixel_high = 1;
  double operator()(double value) const {
    return pixel_low + (value - data_low) / (data_high - data_low) * (pixel_high - pixel_low);
  }
};

/// Pixel coordinates, rounded to a tenth of a pixel.
inline std::string px(double value) { return fixed(value, 1); }

inline std::string number(double value, int digits) { return significant(value, digits); }

inline std::string textAt(double x, double y, const std::string& css_class, const std::string& escaped) {
  return "<text class=\"" + css_class + "\" x=\"" + px(x) + "\" y=\"" + px(y) + "\">" + escaped + "</text>\n";
}

inline std::string lineFromTo(double x1, double y1, double x2, double y2, const std::string& css_class) {
  return "<line class=\"" + css_class + "\" x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" +
         px(y2) + "\"/>\n";
}

}  // namespace presa::svg
