#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace presa::experiment {

/// Power of one test over the number of subjects.
struct PowerCurve {
  struct Point {
    int subjects = 0;
    double power = 0;
    double low = 0, high = 1;  ///< 95 % interval of Wilson, from the number of studies
  };
  std::string test;           ///< its table and row
  std::vector<Point> points;  ///< measured, by rising number of subjects
  /// The smallest measured number of subjects from which on the power stays at least `wanted`; 0: none.
  int reached(double wanted) const;
};

/// Numbers of subjects, up to the planned one, at which power is measured: at most six.
std::vector<int> curveSizes(int subjects);
PowerCurve::Point powerPoint(int subjects, std::size_t significant, std::size_t studies);

/// Verdict and figure: power over the number of subjects, with the wanted power and the planned number marked.
std::string powerFigure(const std::vector<PowerCurve>& curves, int subjects, double wanted);
/// "subjects,test,power,low,high" per line.
std::string powerCurveCsv(const std::vector<PowerCurve>& curves);

}  // namespace presa::experiment
