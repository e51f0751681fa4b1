#include "apps/studies/lectures/lecture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace presa::lectures {

using Run = Lecture (*)();
static const std::vector<std::pair<std::string, Run>>& all() {
  static const std::vector<std::pair<std::string, Run>> runs{
      {"buzzing", buzzing}, {"tracing", tracing}, {"jitter", jitter}, {"latency", latency}};
  return runs;
}

double Lecture::largestOff() const {
  double largest = 0;
  for (const Point& point : points) largest = std::max(largest, std::abs(point.off()));
  return largest;
}

bool Lecture::holds() const {
  return !points.empty() && std::all_of(points.begin(), points.end(), [this](const Point& point) {
    return std::abs(point.off()) <= tolerance;  // false for NaN
  });
}

const std::vector<std::string>& names() {
  static const std::vector<std::string> list = [] {
    std::vector<std::string> found;
    for (const auto& [name, run] : all()) found.push_back(name);
    return found;
  }();
  return list;
}

Lecture run(const std::string& name) {
  for (const auto& [known, run] : all()) {
    if (known == name) return run();
  }
  throw std::logic_error("no experiment of the lectures is called " + name);
}

}  // namespace presa::lectures
