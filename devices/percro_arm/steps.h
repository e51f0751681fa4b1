#pragma once
#include <vector>

namespace presa::percro {

/// `count` + 1 evenly spaced values.
inline std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(from + (to - from) * i / count);
  return values;
}

}  // namespace presa::percro
