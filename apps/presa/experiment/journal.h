#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace presa::experiment {

using Json = nlohmann::ordered_json;

/// The write-ahead log of a session: one record per line, on disk before append() returns. Each line carries a sum over itself
/// and the line before, so that a torn tail is told from a whole record, and a changed or missing line from a good log.
/// Held under a lock: a session is run by one process at a time. Thread: main.
class Journal {
 public:
  /// What a log holds, read without touching it. E923: a line in the middle is damaged; the tail after the last whole line is
  /// what a crash leaves, and only counted. Throws InputError (E922: cannot be read).
  struct Contents {
    std::vector<Json> records;
    std::size_t good_bytes = 0, torn_bytes = 0;
    std::uint64_t sum = 0;
  };
  static Contents read(const std::string& file);

  /// A new log; throws InputError E920 when there is one already, E922 when it cannot be written.
  static Journal create(const std::string& file);
  /// A log to go on with: what a crash left behind the last whole record is cut off. Throws InputError E921 when another
  /// process runs the session.
  static Journal reopen(const std::string& file, Contents& contents);
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&&) = delete;
  ~Journal();

  /// Throws std::system_error when it cannot be written (disk full); the log then ends with the record before.
  void append(const Json& record);

 private:
  Journal(std::string file, int descriptor, std::size_t size, std::uint64_t sum)
      : file_(std::move(file)), descriptor_(descriptor), size_(size), sum_(sum) {}
  std::string file_;
  int descriptor_;
  std::size_t size_;
  std::uint64_t sum_;
};

}  // namespace presa::experiment
