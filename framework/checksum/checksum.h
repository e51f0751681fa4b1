#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace presa {

/// SHA-256 of a file's bytes, 64 lower-case hexadecimal digits. Throws std::system_error when it cannot be read, and what
/// pluginSymbol throws. Thread: any but the haptic one.
std::string sha256OfFile(const std::string& file);

/// The same of bytes in memory.
std::string sha256OfText(std::string_view text);

/// What the plug-in exports: digest 32 bytes; 0 or an errno.
struct ChecksumPlugin {
  int (*file)(const char* file, unsigned char* digest);
  int (*bytes)(const void* bytes, std::size_t count, unsigned char* digest);
};
inline constexpr const char* kChecksumSymbol = "presaChecksum";

}  // namespace presa
