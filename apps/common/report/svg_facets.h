#pragma once
#include <limits>
#include <string>
#include <vector>

/// Small multiples: plots in rows and columns that share both axes, so that they can be compared. One row and one column make an
/// ordinary plot. Colours are the page's classes "s0" to "s5", by rising strength, with a symbol of its own each.
namespace presa::svg {

struct FacetPoint {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double x = 0, y = 0;
  double low = kNone, high = kNone;    ///< error bar along y; of an area its edges
  double left = kNone, right = kNone;  ///< error bar along x
  double size = 1;                     ///< of a symbol, 1: usual
  std::string label{};                 ///< for the page's hover read-out
};

struct Layer {
  enum class Kind {
    kBars,     ///< from 0; x counts them, side by side
    kSymbols,  ///< with error bars
    kJoined,   ///< the same, joined by a line
    kLine,
    kArea  ///< between low and high, or left and right
  };
  Kind kind = Kind::kSymbols;
  int color = 0;        ///< s0, s1 …; below 0: ink
  bool dashed = false;  ///< of a line
  std::vector<FacetPoint> points{};
  double shift = 0;  ///< of symbols to the right [px], so that they do not hide those of another layer
};

struct Facet {
  std::vector<Layer> layers;
};

struct FacetFigure {
  std::string title;                               ///< for those who cannot see it
  std::string x_label, y_label;                    ///< with unit
  std::vector<std::string> columns{""}, rows{""};  ///< heads; facets stand row by row
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
  double y_most = FacetPoint::kNone;  ///< where the y axis must reach at least
  double facet_height = 0;            ///< [px]; 0: the usual
  bool equal_scales = false;          ///< a circle is round: one axis reaches further than its data
};

std::string render(const FacetFigure& figure);

}  // namespace presa::svg
