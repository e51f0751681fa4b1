#include "framework/checksum/checksum.h"

#include <array>
#include <system_error>

#include "framework/plan/plugin_loader.h"

namespace presa {

std::string sha256OfFile(const std::string& file) {
  static const auto digestOf = reinterpret_cast<Sha256Function>(pluginSymbol("checksum", kSha256Symbol));
  std::array<unsigned char, 32> digest{};
  if (const int error = digestOf(file.c_str(), digest.data()); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot read " + file);
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

}  // namespace presa
