#include "framework/record/record_plugin/table_reader.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "framework/diagnostics/refuse.h"

namespace presa::record {
namespace {

/// The system's own reason when a file cannot be read; HDF5 keeps none.
void checkReadable(const std::string& file) {
  const int fd = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) refuse(603, file, std::string("cannot be read: ") + std::strerror(errno), "check the name");
  const bool busy = flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(fd);
  if (busy) refuse(603, file, "is still being written by a run", "wait until that run has ended");
}

}  // namespace

h5::Handle openRecording(const std::string& file) {
  checkReadable(file);
  if (H5Fis_hdf5(file.c_str()) <= 0) refuse(604, file, "is not an HDF5 file", "recordings are made with --record");
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) refuse(608, file, "is damaged: HDF5 cannot open it", "was it copied completely?");
  h5::Handle handle(id, H5Fclose, "file");
  if (!h5::hasAttribute(handle, "format") || h5::readStringAttribute(handle, "format") != kFormatName) {
    refuse(605, file, "is an HDF5 file but not a Presa recording", "recordings are made with --record");
  }
  const std::uint64_t version = h5::readCountAttribute(handle, "format_version");
  if (version > kFormatVersion) {
    refuse(606, file,
           "has format version " + std::to_string(version) + "; this program reads up to " +
               std::to_string(kFormatVersion),
           "read it with the version of Presa that recorded it: " + h5::readStringAttribute(handle, "program_version"));
  }
  return handle;
}

std::vector<std::string> readFaults(hid_t file) {
  std::vector<std::string> faults;
  for (int i = 1; h5::hasAttribute(file, "fault_" + std::to_string(i)); ++i)
    faults.push_back(h5::readStringAttribute(file, "fault_" + std::to_string(i)));
  return faults;
}

std::vector<HapticTable> hapticTables(hid_t file, const std::string& group, const std::string& number) {
  const h5::Handle parent(H5Gopen2(file, ("haptic/" + group).c_str(), H5P_DEFAULT), H5Gclose, "group " + group);
  std::vector<std::pair<std::uint64_t, HapticTable>> found;
  for (const std::string& name : h5::members(parent)) {
    h5::Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "table " + name);
    const std::uint64_t place = h5::readCountAttribute(dataset, number);
    found.emplace_back(place, HapticTable{name, std::move(dataset)});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<HapticTable> tables;
  for (auto& [place, table] : found) {
    // free bodies leave out the numbers of fixed ones; fingers have none to leave out
    if (number == "finger" && place != tables.size()) throw h5::Failure("the fingers are not numbered from 0");
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace presa::record
