#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

/// The one way to open a file that comes from outside. Only regular files get in (no FIFO, device, folder or socket), none that has
/// more bytes than the caller reads, and no read goes on for ever. Folders: folders.h. Thread: any but the haptic one.
namespace presa::input {

enum class Trouble { kUnreadable, kNotRegular, kTooLarge, kTooSlow };

/// Why a file does not get in.
struct Refusal {
  Trouble trouble = Trouble::kUnreadable;
  int error = 0;     ///< errno when unreadable
  std::string what;  ///< to follow the name of the file: "is a named pipe (FIFO), not a regular file"
  std::string help;  ///< may be empty
  /// E690 not a regular file, E691 too large, E693 too slow; `unreadable`: the reader's own code for a file that cannot be opened.
  int code(int unreadable) const;
  /// Adds it to `diagnostics`; `before` goes before `what`: "the file " or "mesh a.obj: it ".
  void report(int unreadable, const SourceLocation& where, const std::string& before, Diagnostics& diagnostics) const;
};

/// A regular file open for reading; closed with it.
class File {
 public:
  explicit File(int descriptor, std::uint64_t size) : descriptor_(descriptor), size_(size) {}
  ~File();
  File(File&& other) noexcept;
  File& operator=(File&&) = delete;
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int descriptor() const { return descriptor_; }
  /// What the system says, holes included; files of /proc say 0 and hold something all the same.
  std::uint64_t size() const { return size_; }

 private:
  int descriptor_;
  std::uint64_t size_;
};

/// Opens `file` if it is regular and has at most `most` bytes, holes counted. Never waits for another process.
std::optional<File> open(const std::string& file, std::uint64_t most, Refusal& refusal);

/// Up to `count` bytes from where the last read ended; 0 at the end, -1 with errno when it cannot be read.
std::ptrdiff_t readSome(const File& file, void* to, std::size_t count);

/// All bytes of `file`, counted while they come: a file that grows past `most`, or that takes longer than 10 s and 1 s more for
/// each 10 MB, is refused.
std::optional<std::string> read(const std::string& file, std::uint64_t most, Refusal& refusal);

/// The same, for readers whose whole finding is that there is one: throws InputError, `code` when it cannot be opened.
std::string readOrRefuse(const std::string& file, std::uint64_t most, int code);

}  // namespace presa::input
