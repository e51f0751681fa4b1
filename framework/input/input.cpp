#include "framework/input/input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

namespace presa::input {
namespace {

enum InputCode { kNotRegular = 690, kTooLarge = 691, kTooSlow = 693 };
constexpr std::size_t kBlock = std::size_t{1} << 16U;
constexpr double kSlowest = 1e7;  // slowest accepted reading speed [bytes/s], far below any disk

const char* kindOf(mode_t mode) {
  if (S_ISFIFO(mode)) return "a named pipe (FIFO)";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device of the system";
  return "something else";
}

Refusal unreadable(int error) {
  return {Trouble::kUnreadable, error, std::string("cannot be read: ") + std::strerror(error), {}};
}

Refusal notRegular(mode_t mode) {
  if (S_ISDIR(mode)) return {Trouble::kUnreadable, EISDIR, "is a directory, not a file", {}};
  return {Trouble::kNotRegular, 0, std::string("is ") + kindOf(mode) + ", not a regular file",
          "only regular files are read, because others may block or never end"};
}

Refusal tooLarge(const std::string& bytes, std::uint64_t max) {
  return {Trouble::kTooLarge, 0, "has " + bytes + " bytes, at most " + std::to_string(max) + " are read", {}};
}

}  // namespace

int Refusal::code(int unreadable_code) const {
  switch (trouble) {
    case Trouble::kNotRegular:
      return kNotRegular;
    case Trouble::kTooLarge:
      return kTooLarge;
    case Trouble::kTooSlow:
      return kTooSlow;
    default:
      return unreadable_code;
  }
}

void Refusal::report(int unreadable_code, const SourceLocation& where, const std::string& before,
                     Diagnostics& diagnostics) const {
  diagnostics.error(code(unreadable_code), where, before + what, help);
}

File::~File() {
  if (descriptor_ >= 0) ::close(descriptor_);
}
File::File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

std::optional<File> open(const std::string& file, std::uint64_t max, Refusal& refusal) {
  // O_NONBLOCK: do not wait for a writer of a FIFO; O_NOCTTY: do not acquire a controlling terminal
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) {
    const int error = errno;
    struct stat info {};
    const bool strange = error == ENXIO && ::stat(file.c_str(), &info) == 0;  // a socket
    refusal = strange ? notRegular(info.st_mode) : unreadable(error);
    return std::nullopt;
  }
  struct stat info {};
  const int error = ::fstat(descriptor, &info) == 0 ? 0 : errno;
  File opened(descriptor, static_cast<std::uint64_t>(std::max<off_t>(info.st_size, 0)));
  if (error != 0)
    refusal = unreadable(error);
  else if (!S_ISREG(info.st_mode))
    refusal = notRegular(info.st_mode);
  else if (opened.size() > max)
    refusal = tooLarge(std::to_string(opened.size()), max);
  else
    return opened;
  return std::nullopt;
}

std::ptrdiff_t readSome(const File& file, void* to, std::size_t count) {
  ssize_t got = 0;
  do got = ::read(file.descriptor(), to, count);
  while (got < 0 && errno == EINTR);
  return got;
}

std::optional<std::string> read(const std::string& file, std::uint64_t max, Refusal& refusal) {
  using Clock = std::chrono::steady_clock;
  const auto opened = open(file, max, refusal);
  if (!opened) return std::nullopt;
  const double seconds = 10 + static_cast<double>(opened->size()) / kSlowest;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  std::string text;
  text.reserve(opened->size());
  std::array<char, kBlock> block;
  while (true) {
    const std::ptrdiff_t got = readSome(*opened, block.data(), block.size());
    if (got == 0) return text;
    if (got < 0) {
      refusal = unreadable(errno);
      return std::nullopt;
    }
    text.append(block.data(), static_cast<std::size_t>(got));
    // count the bytes actually read: a file may grow meanwhile, and files of /proc report size 0
    if (text.size() > max) {
      refusal = tooLarge("more than " + std::to_string(max), max);
      return std::nullopt;
    }
    if (Clock::now() > end) {
      refusal = {Trouble::kTooSlow,
                 0,
                 "delivered " + std::to_string(text.size()) + " bytes in " + std::to_string(static_cast<int>(seconds)) +
                     " s without reaching its end",
                 {}};
      return std::nullopt;
    }
  }
}

std::string readOrRefuse(const std::string& file, std::uint64_t max, int code) {
  Refusal refusal;
  auto text = read(file, max, refusal);
  if (text) return std::move(*text);
  Diagnostics diagnostics;
  refusal.report(code, {file, 0, 0}, "", diagnostics);
  throw InputError(std::move(diagnostics));
}

}  // namespace presa::input
