#pragma once
#include <string>

namespace presa {

/// SHA-256 of a file's bytes, 64 lower-case hexadecimal digits. Throws std::system_error when it cannot be read, and what
/// pluginSymbol throws. Thread: any but the haptic one.
std::string sha256OfFile(const std::string& file);

/// What the plug-in exports: digest 32 bytes; 0 or an errno.
using Sha256Function = int (*)(const char* file, unsigned char* digest);
inline constexpr const char* kSha256Symbol = "presaSha256";

}  // namespace presa
