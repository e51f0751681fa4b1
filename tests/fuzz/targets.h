#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace presa::fuzz {

/// Reads any bytes as a scene: the result is a scene or errors, never both or neither, and a scene can be read back
/// from its resolved form. A last line `set PATH=VALUE` is used as an override. Returns the violated property, or "".
std::string scene(const std::uint8_t* data, std::size_t size);

/// Any bytes describe damage to a recording, which must then be refused or sound (tests/framework/record/mutation.h).
/// Returns the violated property, or "".
std::string recording(const std::uint8_t* data, std::size_t size);

}  // namespace presa::fuzz
