#include "apps/common/number_text.h"

#include <cstdio>

namespace presa {
namespace {

/// Rounding may leave a minus in front of nothing but zeros.
std::string withoutNegativeZero(const char* text) {
  const std::string all = text;
  return all.starts_with('-') && all.find_first_not_of("-0.") == std::string::npos ? all.substr(1) : all;
}

}  // namespace

std::string fixed(double value, int decimals) {
  char text[352];  // the largest double has 309 digits before the point
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return withoutNegativeZero(text);
}

std::string significant(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return withoutNegativeZero(text);
}

}  // namespace presa
