#include <openssl/evp.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <memory>

#include "framework/record/checksum/checksum.h"

namespace {

int ofFile(int descriptor, unsigned char* digest) {
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) return ENOMEM;
  std::array<unsigned char, 65536> block;
  while (const ssize_t got = ::read(descriptor, block.data(), block.size())) {
    if (got < 0 && errno != EINTR) return errno;
    if (got > 0 && EVP_DigestUpdate(context.get(), block.data(), static_cast<std::size_t>(got)) != 1) return EIO;
  }
  return EVP_DigestFinal_ex(context.get(), digest, nullptr) == 1 ? 0 : EIO;
}

int ofBytes(const void* bytes, std::size_t count, unsigned char* digest) {
  return EVP_Digest(bytes, count, digest, nullptr, EVP_sha256(), nullptr) == 1 ? 0 : EIO;
}

void* begin() {
  EVP_MD_CTX* sum = EVP_MD_CTX_new();
  if (sum == nullptr || EVP_DigestInit_ex(sum, EVP_sha256(), nullptr) == 1) return sum;
  EVP_MD_CTX_free(sum);
  return nullptr;
}

int add(void* sum, const void* bytes, std::size_t count) {
  return EVP_DigestUpdate(static_cast<EVP_MD_CTX*>(sum), bytes, count) == 1 ? 0 : EIO;
}

int finish(void* sum, unsigned char* digest) {
  auto* const context = static_cast<EVP_MD_CTX*>(sum);
  if (EVP_DigestFinal_ex(context, digest, nullptr) != 1) return EIO;
  return EVP_DigestInit_ex(context, EVP_sha256(), nullptr) == 1 ? 0 : EIO;
}

void end(void* sum) { EVP_MD_CTX_free(static_cast<EVP_MD_CTX*>(sum)); }

using Pkey = std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)>;
using Context = std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)>;

int makeKeys(unsigned char* secret, unsigned char* open) {
  const Pkey key(EVP_PKEY_Q_keygen(nullptr, nullptr, "ED25519"), EVP_PKEY_free);
  std::size_t secret_size = 32, open_size = 32;
  const bool good = key && EVP_PKEY_get_raw_private_key(key.get(), secret, &secret_size) == 1 &&
                    EVP_PKEY_get_raw_public_key(key.get(), open, &open_size) == 1;
  return good ? 0 : EIO;
}

int sign(const unsigned char* secret, const void* bytes, std::size_t count, unsigned char* signature) {
  const Pkey key(EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, secret, 32), EVP_PKEY_free);
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  std::size_t size = 64;
  const bool good =
      key && context && EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1 &&
      EVP_DigestSign(context.get(), signature, &size, static_cast<const unsigned char*>(bytes), count) == 1;
  return good ? 0 : EIO;
}

int verify(const unsigned char* open, const void* bytes, std::size_t count, const unsigned char* signature) {
  const Pkey key(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, open, 32), EVP_PKEY_free);
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  if (!key || !context || EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) != 1) return EIO;
  const int result = EVP_DigestVerify(context.get(), signature, 64, static_cast<const unsigned char*>(bytes), count);
  return result == 1 ? 0 : EBADMSG;
}

}  // namespace

extern "C" __attribute__((visibility("default")))
const presa::ChecksumPlugin presaChecksums{ofFile, ofBytes, begin, add, finish, end, makeKeys, sign, verify};
