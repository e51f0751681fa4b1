#pragma once
#include <cmath>

/// Colours as displays and picture files code them (IEC 61966-2-1) and as light; both 0 to 1. Any thread.
namespace presa::srgb {

/// Light of a coded value.
inline double toLinear(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }
/// Coded value of light.
inline double fromLinear(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace presa::srgb
