#pragma once
#include <string>
#include <string_view>

namespace presa {

/// Key pair as two texts of one line each, to be stored in files. The secret key signs, the public key verifies.
struct KeyPair {
  std::string secret, open;
};

/// Ed25519 [RFC 8032] with the system's random numbers. All functions throw as pluginSymbol, and std::system_error when
/// OpenSSL fails. Thread: any but the haptic one.
KeyPair makeKeys();

/// The signature of a message as hexadecimal digits. Throws std::invalid_argument when `secret` is not a secret key.
std::string signMessage(std::string_view secret, std::string_view message);

/// Whether the message was signed with the secret key that belongs to `open`. Throws std::invalid_argument when `open`
/// is not a public key.
bool isSignedBy(std::string_view open, std::string_view message, std::string_view signature);

}  // namespace presa
