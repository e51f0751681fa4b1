#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "framework/plugin/plugin_loader.h"

namespace presa {

/// One characteristic of a device: the published value and that of the driver or its model.
struct Characteristic {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  /// Significance of an agreement. A model fitted to a figure agrees with it, which proves nothing.
  enum class Basis {
    kFitted,   ///< the model was fitted to this figure
    kFollows,  ///< predicted by the model, not an input of it
    kAssumed   ///< depends on unpublished numbers
  };
  std::string name, unit;
  double printed_low = kNone,
         printed_high = kNone;  ///< equal: one number; high infinite: a lower bound; kNone: not published
  double here = kNone;
  double tolerance = 0;  ///< relative, below printed_low and above printed_high
  Basis basis = Basis::kFollows;
  std::string note{};  ///< where it is published, how it was determined

  bool compared() const { return std::isfinite(printed_low); }
  bool agrees() const {
    return here >= printed_low - tolerance * std::abs(printed_low) &&
           (std::isinf(printed_high) || here <= printed_high + tolerance * std::abs(printed_high));
  }
};

struct PlotLine {
  std::string label;
  std::vector<double> x{}, y{};
  int color = 0;  ///< 0 to 5; negative: ink
  bool dashed = false;
  bool symbols = false;  ///< symbols instead of a line
};

/// Values over a grid, drawn as contours. z of (x[i], y[j]) is at [j * x.size() + i]; NaN: no value.
struct PlotMap {
  std::vector<double> x, y, z, levels;
};

struct PlotPanel {
  std::string title;
  std::vector<PlotLine> lines{};
  std::optional<PlotMap> map{};
};

/// Panels side by side with the same axes.
struct DevicePlot {
  std::string name;  ///< of its file
  std::string title, caption, x_label, y_label;
  std::vector<PlotPanel> panels{};
  bool equal_scales = false;  ///< same scale on both axes
  bool y_from_zero = false;
};

/// A number of the model that is not published as such.
struct Assumption {
  std::string name, unit;
  double value = 0;
  std::string origin;  ///< "inferred from …" or "guess"
};

struct Characterisation {
  std::string title, source;  ///< the device, and the publication compared with
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
