#pragma once
#include <string>
#include <string_view>

#include "framework/record/checksum/checksum.h"

/// Shared by the files of this folder.
namespace presa::checksum {

/// The plug-in, loaded at the first call. Throws as pluginSymbol.
const ChecksumPlugin& plugin();

std::string hexOf(const unsigned char* bytes, std::size_t count);
/// False when the text is not `count` bytes in lower-case hexadecimal digits.
bool bytesOf(std::string_view hex, unsigned char* bytes, std::size_t count);

}  // namespace presa::checksum
