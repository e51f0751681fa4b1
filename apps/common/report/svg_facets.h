#pragma once
#include <limits>
#include <string>
#include <vector>

/// Small multiples: plots in rows and columns that share both axes, so that they can be compared. One row and one
/// column make an ordinary plot. Colours are the page's classes "s0" to "s5", by increasing strength, each with its own
/// symbol.
namespace presa::svg {

struct FacetPoint {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double x = 0, y = 0;
  double low = kNone, high = kNone;    ///< error bar along y; edges of an area
  double left = kNone, right = kNone;  ///< error bar along x
  double size = 1;                     ///< of a symbol; 1: default
  std::string label{};                 ///< for the page's hover read-out
};

struct Layer {
  enum class Kind {
    kBars,     ///< bars from 0, side by side; x is their index
    kSymbols,  ///< with error bars
    kJoined,   ///< the same, joined by a line
    kLine,
    kArea  ///< between low and high, or left and right
  };
  Kind kind = Kind::kSymbols;
  int color = 0;        ///< s0, s1 …; below 0: ink
  bool dashed = false;  ///< lines only
  std::vector<FacetPoint> points{};
  double shift = 0;  ///< shifts symbols to the right [px], so that they do not hide those of another layer
};

struct Facet {
  std::vector<Layer> layers;
};

struct FacetFigure {
  std::string title;                               ///< for screen readers
  std::string x_label, y_label;                    ///< with unit
  std::vector<std::string> columns{""}, rows{""};  ///< headings; facets are stored row by row
  std::vector<Facet> facets{};
  std::vector<double> x_ticks{};       ///< empty: round numbers
  std::vector<std::string> x_names{};  ///< instead of x_ticks: categories 0, 1, 2 …
  struct Entry {
    std::string label;
    Layer::Kind kind = Layer::Kind::kSymbols;
    int color = 0;
    bool dashed = false;
  };
  std::vector<Entry> legend{};
  bool y_from_zero = true, x_from_zero = false;
  double y_max = FacetPoint::kNone;  ///< value that the y axis must include
  double facet_height = 0;           ///< [px]; 0: default
  bool x_log = false;                ///< logarithmic; points at x <= 0 are left out. Needs x_ticks
  bool equal_scales = false;         ///< same scale on both axes: one axis extends beyond its data
};

std::string render(const FacetFigure& figure);

}  // namespace presa::svg
