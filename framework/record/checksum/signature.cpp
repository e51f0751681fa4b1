#include "framework/record/checksum/signature.h"

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "framework/record/checksum/plugin.h"

namespace presa {
namespace {

using Key = std::array<unsigned char, 32>;
using Signature = std::array<unsigned char, 64>;

constexpr std::string_view kSecret = "presa-secret-key ed25519 ", kOpen = "presa-public-key ed25519 ";

std::string textOf(std::string_view kind, const Key& key) {
  return std::string(kind) + checksum::hexOf(key.data(), key.size()) + "\n";
}

Key keyOf(std::string_view kind, std::string_view text) {
  Key key{};
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  const bool good = text.starts_with(kind) && checksum::bytesOf(text.substr(kind.size()), key.data(), key.size());
  if (!good) throw std::invalid_argument("is no " + std::string(kind.substr(6, 10)));
  return key;
}

void check(int error, const char* what) {
  if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

}  // namespace

KeyPair makeKeys() {
  Key secret{}, open{};
  check(checksum::plugin().make_keys(secret.data(), open.data()), "cannot make keys");
  return {textOf(kSecret, secret), textOf(kOpen, open)};
}

std::string signMessage(std::string_view secret, std::string_view message) {
  const Key key = keyOf(kSecret, secret);
  Signature signature{};
  check(checksum::plugin().sign(key.data(), message.data(), message.size(), signature.data()), "cannot sign");
  return checksum::hexOf(signature.data(), signature.size());
}

bool isSignedBy(std::string_view open, std::string_view message, std::string_view signature) {
  const Key key = keyOf(kOpen, open);
  Signature bytes{};
  if (!checksum::bytesOf(signature, bytes.data(), bytes.size())) return false;
  const int error = checksum::plugin().verify(key.data(), message.data(), message.size(), bytes.data());
  if (error != EBADMSG) check(error, "cannot check a signature");
  return error == 0;
}

}  // namespace presa
