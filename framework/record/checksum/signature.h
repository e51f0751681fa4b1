#pragma once
#include <string>
#include <string_view>

namespace presa {

/// Two texts of one line each, to be kept in files: who has the secret one signs, who has the public one checks.
struct KeyPair {
  std::string secret, open;
};

/// Ed25519 [RFC 8032], from the system's random numbers. All throw what pluginSymbol throws, and std::system_error when OpenSSL fails.
/// Thread: any but the haptic one.
KeyPair makeKeys();

/// The signature of a message in hexadecimal digits. Throws std::invalid_argument when the text is no secret key.
std::string signMessage(std::string_view secret, std::string_view message);

/// Whether the holder of the secret key that belongs to `open` signed this message. Throws std::invalid_argument when the text is no
/// public key.
bool isSignedBy(std::string_view open, std::string_view message, std::string_view signature);

}  // namespace presa
