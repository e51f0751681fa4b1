#pragma once
#include <cstdint>
#include <string>

#include "framework/record/record_plugin/h5.h"

namespace presa::record {

struct OpenedFile {
  h5::Handle handle;
  std::uint64_t version = 0;  ///< format version, supported by this program
  std::uint64_t bytes = 0;    ///< file size
};

/// Opens a regular file whose attributes identify it as a recording. Throws InputError E603 to E606, E608, E690, E691.
OpenedFile openFile(const std::string& file);

}  // namespace presa::record
