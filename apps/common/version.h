#pragma once
namespace presa {
inline constexpr const char* kVersion = PRESA_VERSION;
}  // namespace presa
