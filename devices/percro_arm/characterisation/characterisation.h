#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/plugin/plugin_loader.h"

namespace presa {

/// One figure of a device: as it is printed of it, and as the driver or its model gives it.
struct Characteristic {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  /// What agreement means. A model that was fitted to a figure agrees with it and proves nothing.
  enum class Basis {
    kFitted,   ///< the model was made from this figure
    kFollows,  ///< it comes out of the model without having been put in
    kAssumed   ///< rests on numbers that nobody printed
  };
  std::string name, unit;
  double printed_low = kNone,
         printed_high = kNone;  ///< equal: one number; high infinite: at least; none: nothing is printed
  double here = kNone;
  double tolerance = 0;  ///< beyond printed_low and printed_high, as a share of each
  Basis basis = Basis::kFollows;
  std::string note{};  ///< where it is printed, how it was found

  bool compared() const { return std::isfinite(printed_low); }
  bool agrees() const {
    return here >= printed_low - tolerance * std::abs(printed_low) &&
           (std::isinf(printed_high) || here <= printed_high + tolerance * std::abs(printed_high));
  }
};

struct PlotLine {
  std::string label;
  std::vector<double> x{}, y{};
  int color = 0;  ///< 0 to 5; below 0: ink
  bool dashed = false;
  bool symbols = false;  ///< instead of a line
};

/// Heights over a grid, to be drawn as contours. z of (x[i], y[j]) at [j * x.size() + i]; NaN: nothing there.
struct PlotMap {
  std::vector<double> x, y, z, levels;
};

struct PlotPanel {
  std::string title;
  std::vector<PlotLine> lines{};
  std::optional<PlotMap> map{};
};

/// Panels side by side on the same axes.
struct DevicePlot {
  std::string name;  ///< of a file
  std::string title, caption, x_label, y_label;
  std::vector<PlotPanel> panels{};
  bool equal_scales = false;  ///< a circle is round
  bool y_from_zero = false;
};

/// A number of the model that is printed nowhere, or not as such.
struct Assumption {
  std::string name, unit;
  double value = 0;
  std::string origin;  ///< "inferred from …" or "guess"
};

struct Characterisation {
  std::string title, source;  ///< what was looked at, what it is compared with
  std::vector<Characteristic> figures{};
  std::vector<DevicePlot> plots{};
  std::vector<Assumption> assumptions{};
};

struct CharacterisationPlugin {
  int abi = kPluginAbi;
  Characterisation (*make)() = nullptr;  ///< takes seconds
};
inline constexpr const char* kCharacterisationSymbol = "presaDeviceCharacterisation";

}  // namespace presa

#define PRESA_DEVICE_CHARACTERISATION(table)                                             \
  extern "C" __attribute__((visibility("default"))) const presa::CharacterisationPlugin* \
  presaDeviceCharacterisation() {                                                        \
    return &(table);                                                                     \
  }
