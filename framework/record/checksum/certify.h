#pragma once
#include <string>

namespace presa {

/// A private key and what says whose it is, both PEM. Elliptic curve P-256, SHA-256.
struct Certificate {
  std::string key, certificate;
};

/// What the plug-in exports (OpenSSL). All throw std::runtime_error with OpenSSL's reason. Thread: any but the haptic one.
struct CertifyPlugin {
  /// One that signs others, and itself.
  Certificate (*authority)(const std::string& name, int days);
  /// One of somebody else; `name` is its only field, CN.
  Certificate (*certify)(const Certificate& authority, const std::string& name, int days);
  /// The text with the authority's signature: S/MIME, PKCS#7, the text readable beside it.
  std::string (*sign)(const Certificate& authority, const std::string& text);
};
inline constexpr const char* kCertifySymbol = "presaCertify";

/// Loads the plug-in at the first call; throws what pluginSymbol throws.
const CertifyPlugin& certifyPlugin();

}  // namespace presa
