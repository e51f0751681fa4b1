#include "framework/record/record_plugin/seal.h"

#include <algorithm>

#include "framework/record/checksum/checksum.h"
#include "framework/record/record_plugin/recording_file.h"

namespace presa::record::seal {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;  // maximum size of an attribute

/// All attributes that a run writes, except `complete`, which is written after the checksum.
const char* const kRootAttributes[] = {"format",          "format_version",    "dropped",
                                       "program_version", "start_utc",         "scene_name",
                                       "scene_file",      "rig_file",          "seed",
                                       "force_share",     "realtime",          "haptic_period_s",
                                       "rate_haptic_hz",  "rate_collision_hz", "rate_dynamics_hz",
                                       "rate_view_hz",    kMeshSumsAttribute};
const char* const kTexts[] = {"scene_xml", "rig_xml", "body_names"};
const char* const kTableAttributes[] = {"finger", "body",         "fingertip_radius_m", "columns",
                                        "units",  "descriptions", kInputsAttribute,     kPhasesAttribute};

class Sum {
 public:
  /// Prefixes the length, so that different lists of words never give the same bytes.
  void add(const std::string& word) {
    const std::uint64_t length = word.size();
    sum_.add(&length, sizeof length);
    sum_.add(word.data(), word.size());
  }
  void attribute(hid_t object, const std::string& name) {
    if (!h5::hasAttribute(object, name)) return;
    add(name);
    const h5::Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
    const h5::Handle type(H5Aget_type(attribute), H5Tclose, "attribute " + name);
    const h5::Handle space(H5Aget_space(attribute), H5Sclose, "attribute " + name);
    add(bytesOf(type, space, "attribute " + name, [&](void* to) { return H5Aread(attribute, type, to); }));
  }
  void text(hid_t file, const std::string& name) {
    add(name);
    const h5::Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, "text " + name);
    const h5::Handle type(H5Dget_type(dataset), H5Tclose, "text " + name);
    const h5::Handle space(H5Dget_space(dataset), H5Sclose, "text " + name);
    const auto stored = static_cast<std::size_t>(H5Dget_storage_size(dataset));
    add(bytesOf(
        type, space, name, [&](void* to) { return H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to); },
        stored));
  }
  std::string finish() { return sum_.finish(); }

 private:
  template <class Read>
  static std::string bytesOf(hid_t type, hid_t space, const std::string& what, const Read& read,
                             std::size_t max = kMaxBytes) {
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    const std::size_t size = H5Tget_size(type);
    // variable-length values are refused: their size is not in the type
    if (count < 0 || size == 0 || H5Tdetect_class(type, H5T_VLEN) != 0 || H5Tis_variable_str(type) > 0 ||
        static_cast<std::uint64_t>(count) > max / size)
      throw h5::Failure(what + " is too long or has a type that recordings do not use");
    std::string bytes(static_cast<std::size_t>(count) * size, '\0');
    if (!bytes.empty()) h5::check(read(bytes.data()), what);
    return bytes;
  }

  Sha256 sum_;
};

}  // namespace

std::string open() { return std::string(64, '0'); }

std::string sumOf(hid_t file, std::vector<TableSum> tables) {
  std::sort(tables.begin(), tables.end(), [](const TableSum& a, const TableSum& b) { return a.path < b.path; });
  Sum sum;
  for (const char* name : kRootAttributes) sum.attribute(file, name);
  for (std::uint64_t i = 1; i <= RecordingFile::kMaxFaults; ++i) {
    const std::string fault = "fault_" + std::to_string(i);
    if (!h5::hasAttribute(file, fault)) break;
    sum.attribute(file, fault);
  }
  for (const char* name : kTexts) sum.text(file, name);
  for (const TableSum& table : tables) {
    sum.add(table.path);
    sum.add(std::to_string(table.rows));
    sum.add(table.sha256);
    const h5::Handle dataset(H5Dopen2(file, table.path.c_str(), H5P_DEFAULT), H5Dclose, "table " + table.path);
    for (const char* name : kTableAttributes) sum.attribute(dataset, name);
  }
  return sum.finish();
}

}  // namespace presa::record::seal
