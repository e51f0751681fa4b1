#pragma once
#include <cstddef>
#include <string>
#include <vector>

/// Plots as SVG text for a self-contained page. Colours are CSS classes ("finger", "object", "force" …) that the page
/// defines for light, dark and print. All text is escaped here.
namespace presa::svg {

struct Point {
  double x = 0, y = 0;
};

/// A shaded, named interval of the time axis.
struct Band {
  std::string label;
  double begin = 0, end = 0;
};

/// A named moment, marked by a line through all panels.
struct Event {
  std::string label;
  double time = 0;
};

/// A reference level, drawn across the panel.
struct Level {
  double value = 0;
  std::string label;
  std::string css_class;
};

struct Series {
  std::string label;
  std::string css_class;
  std::vector<double> y;  ///< as TimeFigure::time; NaN interrupts the line
  bool step = false;      ///< keeps its value until the next sample
  /// Min and max from each sample up to the next, of a faster signal than `y`: the line then shows all of it. Both
  /// empty: none.
  std::vector<double> low{}, high{};
};

/// One plot of a stack that shares the time axis.
struct Panel {
  std::string title;                 ///< "Height"
  std::string unit{};                ///< "m"; may be empty
  double height = 160;               ///< of the plotting area [px]
  bool from_zero = false;            ///< the y axis includes 0
  std::vector<std::string> names{};  ///< if not empty: labels of y = 0, 1, 2 …
  std::vector<Series> series{};
  std::vector<Level> levels{};
  std::vector<Band> spans{};  ///< named strips along its top edge: the bodies that a finger touched
};

struct TimeFigure {
  std::string title;         ///< for screen readers
  std::vector<double> time;  ///< x values of all panels, usually time; ascending
  std::string x_label = "time [s]";
  double max_step = 0;  ///< curves are interrupted where samples are farther apart, as nothing is known there; 0: never
  std::vector<Band> bands{};
  std::vector<Event> events{};
  std::vector<Panel> panels{};
  double detail = 1;  ///< share of the points that a figure has at most, for pages with many figures; extremes stay
};

struct Cloud {
  std::string label;
  std::string css_class;
  std::vector<Point> points;
};
/// Straight line through the origin.
struct Ray {
  std::string label;
  std::string css_class;
  double slope = 0;
};
struct Mark {
  std::string label;
  std::string css_class;
  Point at;
};
struct ScatterFigure {
  std::string title;
  std::string x_label, y_label;  ///< with unit
  std::vector<Cloud> clouds;
  std::vector<Ray> rays;
  std::vector<Mark> marks;
};

/// Colours that are told apart, s0 to s5, and after kRamp an ordered ramp, r0 to r11, whose lightness rises or falls
/// throughout: for more values than there are colours.
inline constexpr int kColors = 6, kRamp = 100, kRampSteps = 12;

/// One setting of a work–precision diagram.
struct WorkPoint {
  Point at;                      ///< cost, error; an error of 0 lies on the bottom edge
  double x_low = 0, x_high = 0;  ///< spread of the cost
  std::string label;             ///< shown under the pointer
  std::string css_class;         ///< "usual", "front", "other"
  bool failed = false;           ///< a cross on the top edge
  int color = -1, shape = 0;     ///< instead of the circle of the class: as above, and svg::symbolPath
  std::string tag{};             ///< direct label; empty: none
};
/// Error over cost, both logarithmic.
struct WorkFigure {
  std::string title;
  std::string x_label, y_label;  ///< with unit
  std::vector<WorkPoint> points;
  std::vector<Point> front;       ///< Pareto front, by rising cost
  std::vector<Level> x_levels{};  ///< the period
  std::vector<Level> y_levels{};  ///< just-noticeable differences
  double floor = 0;               ///< error of the reference itself; 0: none
  std::string legend{};           ///< line of text inside the plot, at its top
  struct Entry {
    std::string label;
    int color = -1, shape = 0;
  };
  std::vector<Entry> entries{};  ///< what the colours and shapes mean, below the plot
};

/// The panels over one time axis, with bands, events, a label at the end of each curve and the data for the page's
/// hover read-out. Every figure has links below it that save it as SVG and CSV.
std::string render(const TimeFigure& figure);
/// Both axes from 0.
std::string render(const ScatterFigure& figure);
/// Every point carries its label for the page's hover read-out and for readers without one (title). Of more than a
/// thousand points, one is drawn and saved for each place.
std::string render(const WorkFigure& figure);

/// Round numbers (1, 2 or 5 times a power of ten apart) inside [low, high], about `target` of them.
std::vector<double> niceTicks(double low, double high, int target);
/// The number with as many decimals as ticks `step` apart need; beyond five as a power of ten, "5.8e-06".
std::string tickText(double value, double step);
/// Thins a polyline for a plot `columns` pixels wide to the first, lowest, highest and last point of every column.
/// Points are kept or dropped, never moved; no extreme is lost.
std::vector<Point> decimate(const std::vector<Point>& line, double x_low, double x_high, int columns);
/// The names of the spans for a title, each once: ", touching cube, table"; at most three.
std::string touching(const std::vector<Band>& spans);
/// Text with & < > " ' replaced by entities.
std::string escape(const std::string& text);

}  // namespace presa::svg
