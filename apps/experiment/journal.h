#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace presa::experiment {

using Json = nlohmann::ordered_json;

inline constexpr const char* kJournal = "journal.jsonl";  ///< the log's file in the folder of a session

/// The write-ahead log of a session: one JSON record per line, on disk before append() returns. Each line carries the
/// SHA-256 of the previous line's sum followed by its own record, so a changed, missing or added line is detected. A
/// last line without its end is the trace of a crash. A copy of the last sum proves the whole log later, and, by the
/// sums in the log, every file. The log is locked while it is open: one process at a time runs a session. Thread: main.
class Journal {
 public:
  /// Contents of a log, read without changing it. Throws InputError: E922 cannot be read; E923 a complete line is
  /// damaged or has the format from before SHA-256. An incomplete last line is only counted (`torn_bytes`).
  struct Contents {
    std::vector<Json> records;
    std::size_t good_bytes = 0, torn_bytes = 0;
    std::string sum;  ///< sum of the last record: the seal of the whole log
  };
  static Contents read(const std::string& file);

  /// Creates a log. Throws InputError E920 when it exists already, E922 when it cannot be written.
  static Journal create(const std::string& file);
  /// Opens a log to append to it and cuts off an incomplete last line. Throws InputError E921 when another process runs
  /// the session.
  static Journal reopen(const std::string& file, Contents& contents);
  /// Only locks the session for the lifetime of the object; the log may be damaged. Throws InputError E921, E922.
  static Journal hold(const std::string& file);
  Journal(Journal&& other) noexcept;
  Journal& operator=(Journal&&) = delete;
  ~Journal();

  /// Throws std::system_error when the record cannot be written (disk full); the log then ends with the previous
  /// record.
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
