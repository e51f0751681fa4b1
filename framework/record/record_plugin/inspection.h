#pragma once
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/h5.h"

namespace presa::record {

/// Inspects the objects of an untrusted file without opening unsafe storage. Every link on a path must be hard, every
/// object must have one name, data must be neither filtered nor virtual nor external, and the total size must not
/// exceed the file's. Findings go to `findings`; a query that fails returns its default value. The path "" is the root.
/// Thread: holder of an h5::Library. Throws h5::Failure when HDF5 itself fails.
class Inspection {
 public:
  Inspection(const std::string& name, hid_t file, std::uint64_t file_bytes, Diagnostics& findings)
      : name_(name), file_(file), file_bytes_(file_bytes), left_(file_bytes), findings_(findings) {}

  void wrong(int code, const std::string& object, const std::string& what);
  /// Raises the limit on the total size by `bytes` beyond the file's size.
  void allow(std::uint64_t bytes) { left_ += bytes; }

  /// The parent groups must have been checked before.
  bool isGroup(const std::string& path);
  std::vector<std::string> members(const std::string& path) const;

  std::optional<std::uint64_t> count(const std::string& object, const std::string& attribute, std::uint64_t min,
                                     std::uint64_t max);
  /// NaN when the attribute is missing, of another type or out of range.
  double real(const std::string& object, const std::string& attribute, double min, double max);
  std::string text(const std::string& object, const std::string& attribute);

  /// The text of a dataset that holds exactly one.
  std::string longText(const std::string& path);
  /// Number of texts in a dataset.
  std::uint64_t textCount(const std::string& path, std::uint64_t max);

  struct Rows {
    h5::Handle dataset;
    std::uint64_t rows;
  };
  /// A table with these columns. `may_lack`: rows at the end may be unallocated (killed run); they are not counted.
  std::optional<Rows> table(const std::string& path, const Table& columns, bool may_lack);

 private:
  bool isReached(const std::string& path);
  bool isLinkedPlainly(const std::string& parent, const std::string& name, const std::string& path);
  std::optional<h5::Handle> dataset(const std::string& path);
  bool isStoredPlainly(const std::string& path, hid_t properties);
  bool hasColumns(const std::string& path, hid_t dataset, const Table& columns);
  std::optional<h5::Handle> attribute(const std::string& object, const std::string& name);
  bool spend(std::uint64_t bytes);

  const std::string& name_;
  hid_t file_;
  std::uint64_t file_bytes_, left_;
  std::set<haddr_t> seen_;  // objects
  Diagnostics& findings_;
};

}  // namespace presa::record
