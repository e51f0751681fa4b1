#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace presa {

/// All bytes of a file; empty when it cannot be read.
inline std::string contentsOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace presa
