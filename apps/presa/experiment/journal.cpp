#include "apps/presa/experiment/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "framework/diagnostics/refuse.h"

namespace presa::experiment {
namespace {

constexpr std::uint64_t kStart = 0xcbf29ce484222325;
constexpr std::string_view kHead = "{\"sum\":\"", kMiddle = "\",\"record\":";
constexpr std::size_t kDigits = 16;

/// FNV-1a, begun with the sum of the line before.
std::uint64_t sumOf(std::uint64_t before, std::string_view text) {
  for (const char c : text) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return before;
}

std::string hex(std::uint64_t sum) {
  std::array<char, kDigits + 1> text{};
  std::snprintf(text.data(), text.size(), "%016" PRIx64, sum);
  return text.data();
}

int openLocked(const std::string& file, int flags) {
  const int descriptor = ::open(file.c_str(), flags | O_WRONLY | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    if (errno == EEXIST)
      refuse(920, file, "there is a session already",
             "presa experiment resume goes on with it; nothing is ever overwritten");
    refuse(922, file, std::string("cannot be written: ") + std::strerror(errno));
  }
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    ::close(descriptor);
    refuse(921, file, "another process is running this session");
  }
  return descriptor;
}

/// The record of a line, when its sum is right.
std::optional<std::string_view> recordOf(std::string_view line, std::uint64_t before) {
  const std::size_t start = kHead.size() + kDigits + kMiddle.size();
  if (line.size() <= start || !line.starts_with(kHead) || line.back() != '}') return std::nullopt;
  if (line.substr(kHead.size() + kDigits, kMiddle.size()) != kMiddle) return std::nullopt;
  const std::string_view record = line.substr(start, line.size() - start - 1);
  if (line.substr(kHead.size(), kDigits) != hex(sumOf(before, record))) return std::nullopt;
  return record;
}

}  // namespace

Journal::Contents Journal::read(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(922, file, std::string("cannot be read: ") + std::strerror(errno));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  Contents contents;
  contents.sum = kStart;
  int line_number = 0;
  for (std::size_t at = 0; at < text.size();) {
    ++line_number;
    const std::size_t end = text.find('\n', at);
    const auto record =
        end == std::string::npos ? std::nullopt : recordOf(std::string_view(text).substr(at, end - at), contents.sum);
    if (!record) {
      // a crash tears only the last line
      if (end != std::string::npos && end + 1 < text.size())
        refuse(923, file, "line " + std::to_string(line_number) + " was changed, or one before it is missing");
      contents.torn_bytes = text.size() - at;
      break;
    }
    contents.records.push_back(Json::parse(*record));
    contents.sum = sumOf(contents.sum, *record);
    at = contents.good_bytes = end + 1;
  }
  return contents;
}

Journal Journal::create(const std::string& file) { return {file, openLocked(file, O_CREAT | O_EXCL), 0, kStart}; }

Journal Journal::reopen(const std::string& file, Contents& contents) {
  const int descriptor = openLocked(file, 0);
  Journal journal(file, descriptor, 0, kStart);  // closes it if reading throws
  contents = read(file);                         // again, now that nobody else writes
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
      sum_(other.sum_) {}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::append(const Json& record) {
  const std::string text = record.dump();
  const std::uint64_t sum = sumOf(sum_, text);
  const std::string line = std::string(kHead) + hex(sum) + std::string(kMiddle) + text + "}\n";
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
    // half a record would look like damage to the next one
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) error = errno;
    throw std::system_error(error, std::generic_category(), "cannot write " + file_);
  }
  size_ += line.size();
  sum_ = sum;
}

}  // namespace presa::experiment
