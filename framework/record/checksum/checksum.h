#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace presa {

/// SHA-256 of a file's bytes, 64 lower-case hexadecimal digits. Throws std::system_error when it cannot be read, InputError when
/// it is no regular file (framework/input), and what pluginSymbol throws. Thread: any but the haptic one.
std::string sha256OfFile(const std::string& file);

/// The same of bytes in memory.
std::string sha256OfText(std::string_view text);

/// SHA-256 of bytes that come one after another, too many to hold at once. Throws std::system_error, and at its making what
/// pluginSymbol throws. Thread: any but the haptic one, one at a time.
class Sha256 {
 public:
  Sha256();
  void add(const void* bytes, std::size_t count);
  /// Of all that was added, 64 lower-case hexadecimal digits; the next add() begins anew.
  std::string finish();

 private:
  std::unique_ptr<void, void (*)(void*)> sum_;
};

/// What the plug-in exports: digest 32 bytes; 0 or an errno.
struct ChecksumPlugin {
  int (*file)(int descriptor, unsigned char* digest);  ///< from where it stands to its end
  int (*bytes)(const void* bytes, std::size_t count, unsigned char* digest);
  /// Of bytes that come one after another; null: no memory. finish() writes the digest and begins anew.
  void* (*begin)();
  int (*add)(void* sum, const void* bytes, std::size_t count);
  int (*finish)(void* sum, unsigned char* digest);
  void (*end)(void* sum);
  /// Ed25519 [RFC 8032]: keys of 32 bytes, signatures of 64; EBADMSG when it is another's or of another message.
  int (*make_keys)(unsigned char* secret, unsigned char* open);
  int (*sign)(const unsigned char* secret, const void* bytes, std::size_t count, unsigned char* signature);
  int (*verify)(const unsigned char* open, const void* bytes, std::size_t count, const unsigned char* signature);
};
inline constexpr const char* kChecksumSymbol = "presaChecksums";

}  // namespace presa
