#pragma once
#include <fstream>
#include <iterator>
#include <string>

namespace presa::experiment {

inline std::string contentsOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace presa::experiment
