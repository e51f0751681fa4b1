#pragma once
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/h5.h"

namespace presa::record {

/// Looks at the objects of a file that nobody vouches for, without opening what is not stored in it plainly: each link on the way is a
/// hard one, each object has one name, bytes are neither filtered nor virtual nor in another file, and all of them together are no more
/// than the file has. Findings go to `findings`; what is asked for then has its default. "" is the root.
/// Thread: holder of the library. Throws h5::Failure where HDF5 itself fails.
class Inspection {
 public:
  Inspection(const std::string& name, hid_t file, std::uint64_t file_bytes, Diagnostics& findings)
      : name_(name), file_(file), file_bytes_(file_bytes), left_(file_bytes), findings_(findings) {}

  void wrong(int code, const std::string& object, const std::string& what);
  /// So many bytes more than the file has.
  void allow(std::uint64_t bytes) { left_ += bytes; }

  /// Those around it were asked for before.
  bool isGroup(const std::string& path);
  std::vector<std::string> members(const std::string& path) const;

  std::optional<std::uint64_t> count(const std::string& object, const std::string& attribute, std::uint64_t min,
                                     std::uint64_t max);
  /// NaN where it is none.
  double real(const std::string& object, const std::string& attribute, double min, double max);
  std::string text(const std::string& object, const std::string& attribute);

  /// A dataset that is one text.
  std::string longText(const std::string& path);
  /// How many texts a dataset lists.
  std::uint64_t textCount(const std::string& path, std::uint64_t most);

  struct Rows {
    h5::Handle dataset;
    std::uint64_t rows;
  };
  /// A table with these columns. `may_lack`: rows at its end may be without bytes (the run was killed), and do not count.
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
