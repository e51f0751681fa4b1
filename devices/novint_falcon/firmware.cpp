#include "devices/novint_falcon/firmware.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "devices/novint_falcon/codes.h"
#include "framework/input/input.h"
#include "framework/record/checksum/checksum.h"

namespace presa::falcon {
namespace {

constexpr std::size_t kMaxSize = 65536;
constexpr std::array<std::uint8_t, 2> kFirstBytes{0xAA, 0x08};  // of the processor's boot table

// SHA-256 of nvent (the release), T0, T2
constexpr std::array<std::string_view, 3> kKnown{"1119e39c39fab1f37678ea62dfc715b23dd86ee7f13d78f88f707d9f09b896a1",
                                                 "ae838730af34b5822c9c3949859b446614af0410730b832cc17a6ad627ea64a4",
                                                 "e0ae3598670fa1c8d9277bd6943c99b3152b97c400c46c1c42c60de77ff4e816"};

void checkSum(const std::string& file, const std::string& bytes, const SourceLocation& where,
              Diagnostics& diagnostics) {
  std::string sum;
  try {
    sum = sha256OfText(bytes);
  } catch (const std::exception& error) {
    diagnostics.warning(kFirmwareUnknown, where, "the firmware " + quote(file) + " cannot be recognised", error.what());
    return;
  }
  if (std::find(kKnown.begin(), kKnown.end(), sum) != kKnown.end()) return;
  diagnostics.warning(kFirmwareUnknown, where, "the firmware " + quote(file) + " is none of the known files",
                      "it will be loaded anyway; its SHA-256 is " + sum);
}

}  // namespace

std::vector<std::uint8_t> readFirmware(const std::string& file, const SourceLocation& where, Diagnostics& diagnostics) {
  const std::string name = "the firmware " + quote(file);
  input::Refusal refusal;
  const auto found = input::read(file, kMaxSize, refusal);
  if (!found) {
    if (refusal.trouble == input::Trouble::kTooLarge) {
      diagnostics.error(kFirmwareTooLarge, where, name + " has more than 64 KiB", "known files have about 8 KiB");
      return {};
    }
    if (refusal.trouble == input::Trouble::kUnreadable)
      refusal.help = "it comes with the manufacturer's driver; its licence does not allow Presa to include it";
    refusal.report(kFirmwareUnreadable, where, name + " ", diagnostics);
    return {};
  }
  const std::string& bytes = *found;
  const std::string size = std::to_string(bytes.size()) + " bytes";
  if (bytes.empty()) {
    diagnostics.error(kFirmwareEmpty, where, name + " is empty");
  } else if (!std::equal(kFirstBytes.begin(), kFirstBytes.end(), bytes.begin(),
                         [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); })) {
    diagnostics.error(kFirmwareForeign, where, name + " (" + size + ") does not begin with aa 08",
                      "check that this is firmware for the Falcon's processor");
  } else {
    checkSum(file, bytes, where, diagnostics);
    return {bytes.begin(), bytes.end()};
  }
  return {};
}

}  // namespace presa::falcon
