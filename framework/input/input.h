#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

/// The only way to open a file from outside. Accepts regular files only (no FIFO, device, folder or socket), up to a
/// size set by the caller, and limits the time of a read. Allowed folders: folders.h. Thread: any but the haptic one.
namespace presa::input {

enum class Trouble { kUnreadable, kNotRegular, kTooLarge, kTooSlow };

/// The reason why a file was refused.
struct Refusal {
  Trouble trouble = Trouble::kUnreadable;
  int error = 0;     ///< errno, for kUnreadable
  std::string what;  ///< predicate for the file name: "is a named pipe (FIFO), not a regular file"
  std::string help;  ///< may be empty
  /// E690 not a regular file, E691 too large, E693 too slow; otherwise `unreadable`, the reader's code for files it
  /// cannot open.
  int code(int unreadable) const;
  /// Adds an error with the text `before` + `what`; `before` is for example "the file " or "mesh a.obj: it ".
  void report(int unreadable, const SourceLocation& where, const std::string& before, Diagnostics& diagnostics) const;
};

/// A regular file open for reading; the destructor closes it.
class File {
 public:
  explicit File(int descriptor, std::uint64_t size) : descriptor_(descriptor), size_(size) {}
  ~File();
  File(File&& other) noexcept;
  File& operator=(File&&) = delete;
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int descriptor() const { return descriptor_; }
  /// Size reported by the system, holes included; files of /proc report 0.
  std::uint64_t size() const { return size_; }

 private:
  int descriptor_;
  std::uint64_t size_;
};

/// Opens `file` if it is regular and not larger than `max` bytes, holes included. Never waits for another process.
std::optional<File> open(const std::string& file, std::uint64_t max, Refusal& refusal);

/// Reads up to `count` bytes; 0 at the end, -1 with errno on failure.
std::ptrdiff_t readSome(const File& file, void* to, std::size_t count);

/// Reads all bytes of `file`. Refuses a file that grows past `max` bytes, or that takes longer than 10 s plus 1 s per
/// 10 MB.
std::optional<std::string> read(const std::string& file, std::uint64_t max, Refusal& refusal);

/// As read, but throws InputError; `code` is used when the file cannot be opened.
std::string readOrRefuse(const std::string& file, std::uint64_t max, int code);

}  // namespace presa::input
