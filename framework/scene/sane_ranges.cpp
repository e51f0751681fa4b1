#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "framework/scene/scene_parts.h"

namespace presa {
namespace {

enum SaneRangeCode { kHardlyMeant = 227 };

/// The values of an attribute that a scene on a desk can mean. Beyond them a run is possible, but a digit or a unit is
/// likely to be wrong: a warning.
struct SaneRange {
  enum class Of { kEach, kLength };  ///< each number of a list, or the length of a vector
  std::string_view element, attribute;
  double low, high;
  std::string_view unit, reason;
  Of of = Of::kEach;
};

constexpr std::string_view kSizes = "a tenth of the thinnest plate in the tests to a village";
constexpr std::string_view kSizeUnit = "m";
constexpr double kSmallest = 1e-5, kLargest = 1e3;  // [m]

// CONTRIBUTING.md has the same ranges.
constexpr std::array kSaneRanges{
    SaneRange{"world", "gravity", 0, 100, "m/s^2", "four times that of Jupiter", SaneRange::Of::kLength},
    SaneRange{"physics", "mass", 1e-5, 1e3, "kg", "a grain of sand to a small car"},
    SaneRange{"physics", "density", 0.1, 25000, "kg/m^3", "a balloon to osmium"},
    SaneRange{"physics", "force", 0, 1e4, "N", "the weight of the heaviest sane body", SaneRange::Of::kLength},
    SaneRange{"material", "stiffness", 1, 1e6, "N/m",
              "softer is not felt, a steel plate under a fingertip is not harder"},
    SaneRange{"material", "damping", 0, 1e3, "N s/m", "a damper of 2 m / T shakes a hand of m = 0.5 kg at 1 kHz"},
    SaneRange{"friction", "static", 0, 10, "", "sticky rubber has 4"},
    SaneRange{"friction", "dynamic", 0, 10, "", "sticky rubber has 4"},
    SaneRange{"changed", "static", 0, 10, "", "sticky rubber has 4"},
    SaneRange{"changed", "dynamic", 0, 10, "", "sticky rubber has 4"},
    SaneRange{"friction", "torsion", 0, 0.1, "m", "the contact patch of a hand"},
    SaneRange{"friction", "rolling", 0, 0.02, "m", "a soft tyre in sand"},
    SaneRange{"box", "size", kSmallest, kLargest, kSizeUnit, kSizes},
    SaneRange{"sphere", "radius", kSmallest, kLargest, kSizeUnit, kSizes},
    SaneRange{"cylinder", "radius", kSmallest, kLargest, kSizeUnit, kSizes},
    SaneRange{"cylinder", "length", kSmallest, kLargest, kSizeUnit, kSizes},
    SaneRange{"capsule", "radius", kSmallest, kLargest, kSizeUnit, kSizes},
    SaneRange{"capsule", "length", kSmallest, kLargest, kSizeUnit, kSizes},
    SaneRange{"mesh", "scale", 1e-6, 1e3, "", "files in micrometres to files in kilometres"},
    SaneRange{"body", "pos", 0, 1e4, "m", "a picture rounds to 1 mm there", SaneRange::Of::kLength},
    SaneRange{"body", "velocity", 0, 100, "m/s", "fifty times a fast hand", SaneRange::Of::kLength},
    SaneRange{"body", "angular_velocity", 0, 1e3, "rad/s", "a fast motor", SaneRange::Of::kLength},
    SaneRange{"device", "fingertip_radius", 0, 0.1, "m", "a fist"},
    SaneRange{"tool", "stiffness", 1, 1e5, "N/m", "softer is not felt, no device holds a stiffer one"},
    SaneRange{"tool", "turn_stiffness", 1e-3, 1e3, "N m/rad", "softer is not felt, no device holds a stiffer one"},
    SaneRange{"tool", "damping", 0, 1e3, "N s/m", "a damper of 2 m / T shakes a hand of m = 0.5 kg at 1 kHz"},
    SaneRange{"tool", "turn_damping", 0, 10, "N m s/rad", "ten times a wrist's"},
};

std::string shown(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

double lengthOf(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number * number;
  return std::sqrt(sum);
}

void checkRange(const xml::Element& element, const SaneRange& range, Diagnostics& diagnostics) {
  const std::string attribute(range.attribute);
  if (!element.hasAttribute(attribute) || element.flawed(attribute)) return;
  std::vector<double> numbers = element.numbers(attribute);
  const bool vector = range.of == SaneRange::Of::kLength;
  if (vector) numbers = {lengthOf(numbers)};
  const auto outside = [&](double number) { return number < range.low || number > range.high; };
  const auto found = std::ranges::find_if(numbers, outside);
  if (found == numbers.end()) return;
  const std::string unit = range.unit.empty() ? "" : " " + std::string(range.unit);
  diagnostics.warning(kHardlyMeant, element.where(attribute),
                      quote(attribute) + " of " + element.label() + ": found " +
                          (vector ? "|" + element.attribute(attribute) + "| = " : "") + shown(*found) + unit +
                          ", sane: " + shown(range.low) + " to " + shown(range.high) + unit,
                      std::string(range.reason) + "; the value is used as it is");
}

}  // namespace

void checkSaneRanges(const xml::Element& element, Diagnostics& diagnostics) {
  const std::string name = element.name();
  for (const SaneRange& range : kSaneRanges) {
    if (range.element == name) checkRange(element, range, diagnostics);
  }
  for (const xml::Element& child : element.children()) checkSaneRanges(child, diagnostics);
}

}  // namespace presa
