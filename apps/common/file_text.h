#pragma once
#include <filesystem>
#include <string>

#include "framework/input/input.h"

namespace presa {

/// All bytes of a file; empty when it cannot be read. Throws InputError when it is no regular file or has more than 1
/// GiB.
inline std::string contentsOf(const std::filesystem::path& file) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30U;
  input::Refusal refusal;
  auto text = input::read(file.string(), kMaxBytes, refusal);
  if (!text && refusal.trouble != input::Trouble::kUnreadable) input::readOrRefuse(file.string(), kMaxBytes, 0);
  return text ? std::move(*text) : std::string();
}

}  // namespace presa
