#pragma once
#include <cmath>
#include <string>

#include "tests/modules/texture/texture_fixture.h"

namespace presa::test {

/// A sine of 0.2 mm, 2 mm long: heights from 0 to 0.4 mm.
inline constexpr double kAmplitude = 2e-4, kWavelength = 2e-3;
inline constexpr double kHigh = 2 * kAmplitude;  // height of the crests [m]
inline constexpr double kPlace = 1e-6 * kR;      // of the proxy, which ends within that of its place [m]

/// The cube of the texture tests with force perturbation in place of its texture.
inline World perturbedCube(const std::string& form, double gain, const std::string& shape = "sine",
                           double amplitude = kAmplitude) {
  World world = texturedCube({.shape = shape, .amplitude = amplitude, .wavelength = kWavelength});
  PluginElement& element = world.scene.plugin_elements[0];
  element.plugin = element.element = "perturbation";
  element.attributes["form"] = form;
  element.attributes["gain"] = std::to_string(gain);
  return world;
}

inline double heightAt(double x) { return kAmplitude * (1 + std::sin(kTurn * x / kWavelength)); }
inline double slopeAt(double x) { return kAmplitude * kTurn / kWavelength * std::cos(kTurn * x / kWavelength); }

}  // namespace presa::test
