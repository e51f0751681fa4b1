#include "framework/checksum/checksum.h"

#include <array>
#include <cerrno>
#include <system_error>

#include "framework/plan/plugin_loader.h"

namespace presa {
namespace {

using Digest = std::array<unsigned char, 32>;

const ChecksumPlugin& plugin() {
  static const auto* const loaded = reinterpret_cast<const ChecksumPlugin*>(pluginSymbol("checksum", kChecksumSymbol));
  return *loaded;
}

std::string hexOf(const Digest& digest) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

}  // namespace

std::string sha256OfFile(const std::string& file) {
  Digest digest{};
  if (const int error = plugin().file(file.c_str(), digest.data()); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot read " + file);
  return hexOf(digest);
}

std::string sha256OfText(std::string_view text) {
  Digest digest{};
  if (const int error = plugin().bytes(text.data(), text.size(), digest.data()); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot compute a checksum");
  return hexOf(digest);
}

Sha256::Sha256() : sum_(plugin().begin(), plugin().end) {
  if (!sum_) throw std::system_error(ENOMEM, std::generic_category(), "cannot compute a checksum");
}

void Sha256::add(const void* bytes, std::size_t count) {
  if (const int error = plugin().add(sum_.get(), bytes, count); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot compute a checksum");
}

std::string Sha256::finish() {
  Digest digest{};
  if (const int error = plugin().finish(sum_.get(), digest.data()); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot compute a checksum");
  return hexOf(digest);
}

}  // namespace presa
