#include "framework/record/checksum/checksum.h"

#include <array>
#include <cerrno>
#include <system_error>

#include "framework/core/diagnostics/refuse.h"
#include "framework/input/input.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/record/checksum/plugin.h"

namespace presa {
namespace {

/// Maximum file size [bytes]: that of a recording, the largest kind of file.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 40U;

constexpr std::string_view kDigits = "0123456789abcdef";

using Digest = std::array<unsigned char, 32>;

std::string hexOf(const Digest& digest) { return checksum::hexOf(digest.data(), digest.size()); }

}  // namespace

namespace checksum {

const ChecksumPlugin& plugin() {
  static const auto* const loaded = reinterpret_cast<const ChecksumPlugin*>(pluginSymbol("checksum", kChecksumSymbol));
  return *loaded;
}

std::string hexOf(const unsigned char* bytes, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += kDigits[bytes[i] >> 4U];
    text += kDigits[bytes[i] & 15U];
  }
  return text;
}

bool bytesOf(std::string_view hex, unsigned char* bytes, std::size_t count) {
  if (hex.size() != 2 * count) return false;
  for (std::size_t i = 0; i < hex.size(); ++i) {
    const std::size_t digit = kDigits.find(hex[i]);
    if (digit == std::string_view::npos) return false;
    bytes[i / 2] = static_cast<unsigned char>(i % 2 == 0 ? digit << 4U : bytes[i / 2] | digit);
  }
  return true;
}

}  // namespace checksum

std::string sha256OfFile(const std::string& file) {
  Digest digest{};
  input::Refusal refusal;
  const auto opened = input::open(file, kMaxBytes, refusal);
  if (!opened && refusal.trouble != input::Trouble::kUnreadable)
    refuse(refusal.code(0), file, refusal.what, refusal.help);
  if (const int error = opened ? checksum::plugin().file(opened->descriptor(), digest.data()) : refusal.error;
      error != 0)
    throw std::system_error(error, std::generic_category(), "cannot read " + file);
  return hexOf(digest);
}

std::string sha256OfText(std::string_view text) {
  Digest digest{};
  if (const int error = checksum::plugin().bytes(text.data(), text.size(), digest.data()); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot compute a checksum");
  return hexOf(digest);
}

Sha256::Sha256() : sum_(checksum::plugin().begin(), checksum::plugin().end) {
  if (!sum_) throw std::system_error(ENOMEM, std::generic_category(), "cannot compute a checksum");
}

void Sha256::add(const void* bytes, std::size_t count) {
  if (const int error = checksum::plugin().add(sum_.get(), bytes, count); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot compute a checksum");
}

std::string Sha256::finish() {
  Digest digest{};
  if (const int error = checksum::plugin().finish(sum_.get(), digest.data()); error != 0)
    throw std::system_error(error, std::generic_category(), "cannot compute a checksum");
  return hexOf(digest);
}

}  // namespace presa
