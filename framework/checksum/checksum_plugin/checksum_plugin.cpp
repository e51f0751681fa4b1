#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>

#include "framework/checksum/checksum.h"

namespace {

int ofFile(const char* file, unsigned char* digest) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file, "rb"), std::fclose);
  if (!in) return errno;
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) return ENOMEM;
  std::array<unsigned char, 65536> block;
  while (const std::size_t read = std::fread(block.data(), 1, block.size(), in.get()))
    if (EVP_DigestUpdate(context.get(), block.data(), read) != 1) return EIO;
  if (std::ferror(in.get()) != 0) return EIO;
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

}  // namespace

extern "C" __attribute__((visibility("default")))
const presa::ChecksumPlugin presaChecksums{ofFile, ofBytes, begin, add, finish, end};
