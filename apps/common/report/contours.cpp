#include "apps/common/report/contours.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>

namespace presa::svg {
namespace {

/// Crossings are indexed by grid edge; the lines of neighbouring cells meet at their common edge.
struct Crossings {
  std::map<std::size_t, Point> at;                           // by edge
  std::map<std::size_t, std::vector<std::size_t>> joined{};  // edges that a cell's line joins
  void join(std::size_t a, std::size_t b) { joined[a].push_back(b), joined[b].push_back(a); }
  /// Removes and returns the line that starts at `edge`, followed to its end.
  std::vector<Point> take(std::size_t edge) {
    std::vector<Point> line{at.at(edge)};
    while (!joined[edge].empty()) {
      const std::size_t next = joined[edge].back();
      joined[edge].pop_back();
      std::erase(joined[next], edge);
      line.push_back(at.at(edge = next));
    }
    return line;
  }
};

}  // namespace

std::vector<std::vector<Point>> contours(const std::vector<double>& x, const std::vector<double>& y,
                                         const std::vector<double>& z, double level) {
  Crossings crossings;
  const std::size_t columns = x.size();
  const auto height = [&](std::size_t i, std::size_t j) { return z[j * columns + i] - level; };
  // the edge from a grid point to the right (0) or up (1), when the level crosses it
  const auto crossing = [&](std::size_t i, std::size_t j, std::size_t up, std::vector<std::size_t>& found) {
    const double from = height(i, j), to = height(i + 1 - up, j + up);
    if ((from < 0) == (to < 0)) return;
    const double part = from / (from - to);
    const std::size_t edge = 2 * (j * columns + i) + up;
    crossings.at[edge] =
        up ? Point{x[i], y[j] + part * (y[j + 1] - y[j])} : Point{x[i] + part * (x[i + 1] - x[i]), y[j]};
    found.push_back(edge);
  };
  for (std::size_t j = 0; j + 1 < y.size(); ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      if (!std::isfinite(height(i, j) + height(i + 1, j) + height(i, j + 1) + height(i + 1, j + 1))) continue;
      std::vector<std::size_t> found;  // in order round the cell: at a saddle, two lines join neighbouring edges
      crossing(i, j, 0, found), crossing(i + 1, j, 1, found), crossing(i, j + 1, 0, found), crossing(i, j, 1, found);
      for (std::size_t k = 0; k + 1 < found.size(); k += 2) crossings.join(found[k], found[k + 1]);
    }
  }
  std::vector<std::vector<Point>> lines;
  const auto take = [&](bool ends) {
    for (const auto& [edge, neighbours] : std::map(crossings.joined)) {
      const std::size_t left = crossings.joined[edge].size();
      if (left > 0 && (!ends || left == 1)) lines.push_back(crossings.take(edge));
    }
  };
  take(true), take(false);  // open lines from their ends, then closed ones
  return lines;
}

}  // namespace presa::svg
