#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/record/record_plugin/h5.h"

/// The checksum of a recording, which distinguishes a damaged file from a different simulation result. It has no key,
/// so it detects accidents, not malice. Each table has the SHA-256 of its rows as attribute; the root has one over
/// everything: the root's attributes and texts, and the names, lengths, attributes and checksums of the tables.
namespace presa::record::seal {

/// First format version whose complete recordings have a checksum.
inline constexpr std::uint64_t kSince = 6;
inline constexpr const char* kAttribute = "sha256";
/// Placeholder value of the attribute during the run; it remains when the run is killed.
std::string open();

struct TableSum {
  std::string path;
  std::uint64_t rows = 0;
  std::string sha256;  ///< of its rows
};

/// The root's checksum, from the file and the checksums of the tables in any order. Throws h5::Failure,
/// std::system_error.
std::string sumOf(hid_t file, std::vector<TableSum> tables);

}  // namespace presa::record::seal
