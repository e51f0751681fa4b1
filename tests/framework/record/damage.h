#pragma once
#include <cstdint>
#include <string>

#include "framework/record/record_plugin/h5.h"

namespace presa::record {

/// Opens a recording and changes it in ways that no run would. Objects are named by path, "haptic/ticks"; "/" is the
/// root. Thread: the test's, which holds the library while this object exists. Throws h5::Failure.
class Damage {
 public:
  explicit Damage(const std::string& file);

  void cell(const std::string& table, const std::string& column, std::uint64_t row, double value);
  void cell(const std::string& table, const std::string& column, std::uint64_t row, std::int64_t value);
  void everyCell(const std::string& table, const std::string& column, std::int64_t value);
  void rows(const std::string& table, std::uint64_t rows);

  void attribute(const std::string& object, const std::string& name, std::uint64_t value);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void dropAttribute(const std::string& object, const std::string& name);

  void dropLink(const std::string& path);
  void externalLink(const std::string& path, const std::string& file, const std::string& target);
  void softLink(const std::string& path, const std::string& target);
  void hardLink(const std::string& path, const std::string& target);

  /// Replaces a table by one of the same type whose rows are stored elsewhere or nowhere.
  void virtualTable(const std::string& path, const std::string& file, const std::string& source);
  void externallyStored(const std::string& path, const std::string& file);
  void unallocated(const std::string& path, std::uint64_t rows);
  void filtered(const std::string& path, int filter);
  void chunked(const std::string& path, std::uint64_t rows_of_a_chunk);
  /// A fixed-length string of that many bytes, none of which is stored.
  void hugeText(const std::string& path, std::uint64_t bytes);

  std::uint64_t rowsOf(const std::string& table) const;
  hid_t file() const { return file_; }

 private:
  h5::Handle object(const std::string& path) const;
  h5::Handle table(const std::string& path) const;
  void writeCells(const std::string& table, const std::string& column, const h5::Handle& space, hid_t cell,
                  const void* values);
  h5::Handle replace(const std::string& path, const h5::Handle& space, const h5::Handle& properties);

  h5::Library library_;
  h5::Handle file_;
};

}  // namespace presa::record
