#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace presa::experiment {

using Json = nlohmann::ordered_json;

/// The write-ahead log of a session: one record per line, on disk before append() returns. Each line carries the SHA-256 of the
/// sum before it and of its own record, so that a changed, missing or added line is told from a good log; a line without its end
/// is what a crash tears. Whoever notes the last sum can prove the whole log later, and with the sums in it every file.
/// Held under a lock: a session is run by one process at a time. Thread: main.
class Journal {
 public:
  /// What a log holds, read without touching it. Throws InputError: E922 cannot be read; E923 a whole line is damaged, or of
  /// the format before SHA-256. A last line without its end is only counted.
  struct Contents {
    std::vector<Json> records;
    std::size_t good_bytes = 0, torn_bytes = 0;
    std::string sum;  ///< of the last record: the seal of all before it
  };
  static Contents read(const std::string& file);

  /// A new log; throws InputError E920 when there is one already, E922 when it cannot be written.
  static Journal create(const std::string& file);
  /// A log to go on with: what a crash left behind the last whole record is cut off. Throws InputError E921 when another
  /// process runs the session.
  static Journal reopen(const std::string& file, Contents& contents);
  /// Only keeps others from running the session while it lives; the log may be damaged. Throws InputError E921, E922.
  static Journal hold(const std::string& file);
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&&) = delete;
  ~Journal();

  /// Throws std::system_error when it cannot be written (disk full); the log then ends with the record before.
  void append(const Json& record);

 private:
  Journal(std::string file, int descriptor, std::size_t size, std::string sum)
      : file_(std::move(file)), descriptor_(descriptor), size_(size), sum_(std::move(sum)) {}
  std::string file_;
  int descriptor_;
  std::size_t size_;
  std::string sum_;
};

}  // namespace presa::experiment
