#pragma once
#include <cstdint>
#include <string>

#include "framework/record/record_plugin/h5.h"

namespace presa::record {

struct OpenedFile {
  h5::Handle handle;
  std::uint64_t version = 0;  ///< of the format, one that this program knows
  std::uint64_t bytes = 0;    ///< of the file
};

/// A regular file that is a recording, by its own words. Throws InputError E603 to E606, E608, E690, E691.
OpenedFile openFile(const std::string& file);

}  // namespace presa::record
