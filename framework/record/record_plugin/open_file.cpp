#include "framework/record/record_plugin/open_file.h"

#include <sys/file.h>

#include <cerrno>

#include "framework/core/diagnostics/refuse.h"
#include "framework/input/input.h"
#include "framework/record/record_plugin/inspection.h"
#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {
namespace {

/// Maximum size of a recording [bytes]: days of ten fingers.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 40U;

/// Checks that the file can be read and reports the system's reason if not, which HDF5 does not keep. Returns its
/// length.
std::uint64_t checkReadable(const std::string& file) {
  input::Refusal refusal;
  const auto opened = input::open(file, kMaxBytes, refusal);
  if (!opened) refuse(refusal.code(603), file, refusal.what, refusal.help.empty() ? "check the name" : refusal.help);
  const bool busy = flock(opened->descriptor(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (busy) refuse(603, file, "is still being written by a run", "wait until that run has ended");
  return opened->size();
}

}  // namespace

OpenedFile openFile(const std::string& file) {
  OpenedFile opened;
  opened.bytes = checkReadable(file);
  if (H5Fis_hdf5(file.c_str()) <= 0) refuse(604, file, "is not an HDF5 file", "recordings are made with --record");
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) refuse(608, file, "is damaged: HDF5 cannot open it", "was it copied completely?");
  opened.handle = h5::Handle(id, H5Fclose, "file");
  Diagnostics findings;
  Inspection look(file, opened.handle, opened.bytes, findings);
  const bool named = h5::hasAttribute(opened.handle, "format");
  if (!named || look.text("", "format") != kFormatName) {
    refuse(605, file, "is an HDF5 file but not a Presa recording", "recordings are made with --record");
  }
  opened.version = look.count("", "format_version", 1, ~std::uint64_t{0}).value_or(0);
  if (findings.hasErrors()) throw InputError(std::move(findings));
  if (opened.version > kFormatVersion) {
    refuse(606, file,
           "has format version " + std::to_string(opened.version) + "; this program reads up to " +
               std::to_string(kFormatVersion),
           "read it with the version of Presa that recorded it: " + look.text("", "program_version"));
  }
  return opened;
}

}  // namespace presa::record
