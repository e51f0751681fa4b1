#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace presa {

/// SHA-256 of a file's bytes as 64 lower-case hexadecimal digits. Throws std::system_error when it cannot be read,
/// InputError when it is not a regular file (framework/input), and as pluginSymbol. Thread: any but the haptic one.
std::string sha256OfFile(const std::string& file);

/// SHA-256 of bytes in memory, in the same form.
std::string sha256OfText(std::string_view text);

/// Incremental SHA-256, for data too large to hold in memory. Throws std::system_error; the constructor also throws as
/// pluginSymbol. Thread: any but the haptic one, one at a time.
class Sha256 {
 public:
  Sha256();
  void add(const void* bytes, std::size_t count);
  /// The checksum of all bytes added so far, as 64 lower-case hexadecimal digits; the next add() starts a new sum.
  std::string finish();

 private:
  std::unique_ptr<void, void (*)(void*)> sum_;
};

/// Functions exported by the plug-in. Digests are 32 bytes. The functions return 0 or an errno value.
struct ChecksumPlugin {
  int (*file)(int descriptor, unsigned char* digest);  ///< from the descriptor's current offset to the end
  int (*bytes)(const void* bytes, std::size_t count, unsigned char* digest);
  /// Incremental sum. begin() returns null when out of memory; finish() writes the digest and starts a new sum.
  void* (*begin)();
  int (*add)(void* sum, const void* bytes, std::size_t count);
  int (*finish)(void* sum, unsigned char* digest);
  void (*end)(void* sum);
  /// Ed25519 [RFC 8032]: keys of 32 bytes, signatures of 64. verify() returns EBADMSG when the signature does not
  /// match.
  int (*make_keys)(unsigned char* secret, unsigned char* open);
  int (*sign)(const unsigned char* secret, const void* bytes, std::size_t count, unsigned char* signature);
  int (*verify)(const unsigned char* open, const void* bytes, std::size_t count, const unsigned char* signature);
};
inline constexpr const char* kChecksumSymbol = "presaChecksums";

}  // namespace presa
