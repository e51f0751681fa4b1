#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/record/record_plugin/h5.h"

/// The checksum of a recording, so that damage is told from a simulation that came out differently. It proves accidents, not malice:
/// it has no key. SHA-256 of each table's rows, as attribute of the table, and one of everything, as attribute of the root: of what the
/// root's attributes and texts say, of the tables' names, lengths, own attributes and checksums.
namespace presa::record::seal {

/// Since this version of the format a recording that was closed has one.
inline constexpr std::uint64_t kSince = 6;
inline constexpr const char* kAttribute = "sha256";
/// What stands there while a run goes on, and for ever when it is killed.
std::string open();

struct TableSum {
  std::string path;
  std::uint64_t rows = 0;
  std::string sha256;  ///< of its rows
};

/// Of everything but the rows, given their checksums; in any order. Throws h5::Failure, std::system_error.
std::string sumOf(hid_t file, std::vector<TableSum> tables);

}  // namespace presa::record::seal
