#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>

/// The experiments of the haptics lectures, as they can be run without a person: each measures a figure over one knob
/// and stands beside a closed form for it. All runs are in lockstep virtual time, with a finger in code, on the scene
/// experiments/stability/scenes/haptic_wall.xml.
namespace presa::lectures {

/// One value of the knob.
struct Point {
  double x = 0;         ///< as Lecture::x_label says
  std::string knob;     ///< value of the knob with its unit: "500 Hz"
  double measured = 0;  ///< as Lecture::y_label says
  double oracle = 0;    ///< the closed form
  /// The answer without the closed form's approximation; NaN: the closed form is exact.
  double exact = std::numeric_limits<double>::quiet_NaN();

  double reference() const { return std::isnan(exact) ? oracle : exact; }
  /// Relative difference of the measured figure from reference().
  double off() const { return measured / reference() - 1; }
};

struct Lecture {
  std::string name, title, description;
  std::string knob;                    ///< heading of Point::knob
  std::string x_label, y_label;        ///< with unit
  std::string oracle;                  ///< the closed form as text
  std::string exact{};                 ///< how Point::exact is found; empty: the closed form is exact
  double tolerance = 0;                ///< largest |off()| of a point [-]
  std::vector<Point> points;           ///< by rising x
  std::vector<std::string> sentences;  ///< written from the points

  bool holds() const;
  double largestOff() const;
};

/// Names in the order of the lectures.
const std::vector<std::string>& names();
/// Runs the experiment of that name. Throws std::logic_error for any other.
Lecture run(const std::string& name);

Lecture buzzing();
Lecture tracing();
Lecture jitter();
Lecture latency();

}  // namespace presa::lectures
