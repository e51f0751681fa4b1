#include "apps/experiment/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "framework/core/diagnostics/refuse.h"
#include "framework/input/input.h"
#include "framework/record/checksum/checksum.h"

namespace presa::experiment {
namespace {

constexpr std::string_view kHead = "{\"sha256\":\"", kMiddle = "\",\"record\":", kOldHead = "{\"sum\":\"";
constexpr std::size_t kDigits = 64;
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 28U;  // 256 MB; a session of a thousand trials takes 5 MB

/// Sum of a line; `before` is the previous line's sum, empty for the first record.
std::string sumOf(const std::string& before, std::string_view record) {
  return sha256OfText(before + std::string(record));
}

int openLocked(const std::string& file, int flags) {
  // O_NONBLOCK: opening a FIFO would wait for its reader
  const int descriptor = ::open(file.c_str(), flags | O_WRONLY | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    if (errno == EEXIST)
      refuse(920, file, "there is a session already",
             "presa experiment resume goes on with it; nothing is ever overwritten");
    refuse(922, file, std::string("cannot be written: ") + std::strerror(errno));
  }
  struct stat info {};
  if (::fstat(descriptor, &info) != 0 || !S_ISREG(info.st_mode)) {
    ::close(descriptor);
    refuse(922, file, "cannot be written: it is not a regular file");
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    refuse(921, file, "another process is running this session");
  }
  return descriptor;
}

/// The record of a line if its sum is right; `sum` is updated to the line's sum.
std::optional<std::string_view> recordOf(std::string_view line, std::string& sum) {
  const std::size_t start = kHead.size() + kDigits + kMiddle.size();
  if (line.size() <= start || !line.starts_with(kHead) || line.back() != '}') return std::nullopt;
  if (line.substr(kHead.size() + kDigits, kMiddle.size()) != kMiddle) return std::nullopt;
  const std::string_view record = line.substr(start, line.size() - start - 1);
  std::string wanted = sumOf(sum, record);
  if (line.substr(kHead.size(), kDigits) != wanted) return std::nullopt;
  sum = std::move(wanted);
  return record;
}

}  // namespace

Journal::Contents Journal::read(const std::string& file) {
  const std::string text = input::readOrRefuse(file, kMaxBytes, 922);
  if (text.starts_with(kOldHead)) refuse(923, file, "was begun by a version of Presa whose checksums are too weak");
  Contents contents;
  int line_number = 0;
  for (std::size_t at = 0; at < text.size();) {
    ++line_number;
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos) {
      contents.torn_bytes = text.size() - at;
      break;
    }
    const auto record = recordOf(std::string_view(text).substr(at, end - at), contents.sum);
    if (!record) refuse(923, file, "line " + std::to_string(line_number) + " was changed, or one before it is missing");
    contents.records.push_back(Json::parse(*record));
    at = contents.good_bytes = end + 1;
  }
  return contents;
}

Journal Journal::create(const std::string& file) { return {file, openLocked(file, O_CREAT | O_EXCL), 0, {}}; }

Journal Journal::hold(const std::string& file) { return {file, openLocked(file, 0), 0, {}}; }

Journal Journal::reopen(const std::string& file, Contents& contents) {
  const int descriptor = openLocked(file, 0);
  Journal journal(file, descriptor, 0, {});  // closes the descriptor if read() throws
  contents = read(file);                     // read again: under the lock nobody else writes
  if (contents.torn_bytes > 0 && ::ftruncate(descriptor, static_cast<off_t>(contents.good_bytes)) != 0)
    refuse(922, file, std::string("cannot be written: ") + std::strerror(errno));
  journal.size_ = contents.good_bytes;
  journal.sum_ = contents.sum;
  return journal;
}

Journal::Journal(Journal&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      sum_(std::move(other.sum_)) {}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::append(const Json& record) {
  const std::string text = record.dump();
  std::string sum = sumOf(sum_, text);
  const std::string line = std::string(kHead) + sum + std::string(kMiddle) + text + "}\n";
  int error = 0;
  for (std::size_t written = 0; written < line.size() && error == 0;) {
    const ssize_t step = ::write(descriptor_, line.data() + written, line.size() - written);
    if (step >= 0)
      written += static_cast<std::size_t>(step);
    else if (errno != EINTR)
      error = errno;
  }
  if (error == 0 && ::fsync(descriptor_) != 0) error = errno;
  if (error != 0) {
    // cut off the partial record: the next append would make it look like damage
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) error = errno;
    throw std::system_error(error, std::generic_category(), "cannot write " + file_);
  }
  size_ += line.size();
  sum_ = std::move(sum);
}

}  // namespace presa::experiment
