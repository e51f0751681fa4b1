#pragma once
#include <string>

namespace presa {

/// A private key and its X.509 certificate, both PEM. Elliptic curve P-256, SHA-256.
struct Certificate {
  std::string key, certificate;
};

/// Functions exported by the plug-in (OpenSSL). All throw std::runtime_error with OpenSSL's reason. Thread: any but the
/// haptic one.
struct CertifyPlugin {
  /// Makes a self-signed certificate authority.
  Certificate (*authority)(const std::string& name, int days);
  /// Makes a key and a certificate signed by the authority; `name` becomes the subject's CN, its only field.
  Certificate (*certify)(const Certificate& authority, const std::string& name, int days);
  /// Signs a text with the authority's key: S/MIME with a detached PKCS#7 signature, the text in clear.
  std::string (*sign)(const Certificate& authority, const std::string& text);
};
inline constexpr const char* kCertifySymbol = "presaCertify";

/// Loads the plug-in at the first call. Throws as pluginSymbol.
const CertifyPlugin& certifyPlugin();

}  // namespace presa
