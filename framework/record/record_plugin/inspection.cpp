#include "framework/record/record_plugin/inspection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {
namespace {

constexpr std::size_t kLongestAttribute = 65536;  // HDF5's limit for attributes stored in the object header

std::string shortText(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::string kindOf(const H5L_info_t& link) {
  if (link.type == H5L_TYPE_SOFT) return "a soft link";
  return link.type == H5L_TYPE_EXTERNAL ? "an external link" : "a user-defined link";
}

std::string filterText(hid_t properties) {
  unsigned flags = 0;
  std::size_t values = 0;
  const H5Z_filter_t filter = H5Pget_filter2(properties, 0, &flags, &values, nullptr, 0, nullptr, nullptr);
  return "filter " + std::to_string(filter);
}

/// Number of values of an attribute or dataset; -1 when it is neither scalar nor one-dimensional.
hssize_t valuesOf(hid_t space) {
  const H5S_class_t kind = H5Sget_simple_extent_type(space);
  if (kind == H5S_SCALAR) return 1;
  return kind == H5S_SIMPLE && H5Sget_simple_extent_ndims(space) == 1 ? H5Sget_simple_extent_npoints(space) : -1;
}

/// A fixed-length text type. Length 0 is rejected, because HDF5 divides by it.
bool isFixedText(hid_t type) {
  return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 && H5Tget_size(type) > 0;
}

bool isNumber(hid_t type, H5T_class_t kind) {
  const std::size_t bytes = H5Tget_size(type);
  return H5Tget_class(type) == kind && bytes > 0 && bytes <= sizeof(std::uint64_t);
}

}  // namespace

void Inspection::wrong(int code, const std::string& object, const std::string& what) {
  const std::string help = code == 670 ? "a recording stores all data in its own file, without filters"
                                       : "was it copied completely, or changed since it was recorded?";
  findings_.error(code, {name_, 0, 0}, (object.empty() ? "" : object + ": ") + what, help);
}

bool Inspection::spend(std::uint64_t bytes) {
  if (bytes > left_) return false;
  left_ -= bytes;
  return true;
}

// ---- links and objects

bool Inspection::isLinkedPlainly(const std::string& parent, const std::string& name, const std::string& path) {
  const h5::Handle group(H5Oopen(file_, parent.empty() ? "/" : parent.c_str(), H5P_DEFAULT), H5Oclose, parent);
  if (H5Iget_type(group) != H5I_GROUP || H5Lexists(group, name.c_str(), H5P_DEFAULT) <= 0) {
    wrong(672, path, "is missing");
    return false;
  }
  H5L_info_t link;
  h5::check(H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT), "link " + path);
  if (link.type == H5L_TYPE_HARD) return true;
  wrong(670, path, "is " + kindOf(link) + "; only data in the file itself is read");
  return false;
}

/// Checks the last link of the path; the ones before it were checked when their groups were opened.
bool Inspection::isReached(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? isLinkedPlainly("", path, path)
                                    : isLinkedPlainly(path.substr(0, slash), path.substr(slash + 1), path);
}

bool Inspection::isGroup(const std::string& path) {
  if (!isReached(path)) return false;
  const h5::Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose, path);
  if (H5Iget_type(object) == H5I_GROUP) return true;
  wrong(672, path, "is not a group");
  return false;
}

std::vector<std::string> Inspection::members(const std::string& path) const {
  const h5::Handle group(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), H5Gclose, "group " + path);
  return h5::members(group);
}

std::optional<h5::Handle> Inspection::dataset(const std::string& path) {
  if (!isReached(path)) return {};
  H5O_info_t info;
  h5::check(H5Oget_info_by_name2(file_, path.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT), path);
  if (info.type != H5O_TYPE_DATASET) {
    wrong(672, path, "is not a dataset");
    return {};
  }
  if (!seen_.insert(info.addr).second) {
    wrong(670, path, "is a second link to the same object");
    return {};
  }
  h5::Handle dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path);
  // inspect the properties before the extent: HDF5 looks up the extent of a virtual dataset in other files
  const h5::Handle properties(H5Dget_create_plist(dataset), H5Pclose, path);
  if (!isStoredPlainly(path, properties)) return {};
  return dataset;
}

bool Inspection::isStoredPlainly(const std::string& path, hid_t properties) {
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL) {
    wrong(670, path, "is a virtual dataset: its values are in other files");
  } else if (layout == H5D_CONTIGUOUS && H5Pget_external_count(properties) != 0) {
    wrong(670, path, "keeps its values in another file (external storage)");
  } else if (layout == H5D_CHUNKED && H5Pget_nfilters(properties) != 0) {
    wrong(670, path, "is stored through " + filterText(properties) + "; recordings are stored without filters");
  } else if (layout != H5D_CHUNKED && layout != H5D_CONTIGUOUS && layout != H5D_COMPACT) {
    wrong(670, path, "is stored in an unknown way");
  } else {
    return true;
  }
  return false;
}

// ---- attributes

std::optional<h5::Handle> Inspection::attribute(const std::string& object, const std::string& name) {
  const h5::Handle of(H5Oopen(file_, object.empty() ? "/" : object.c_str(), H5P_DEFAULT), H5Oclose, object);
  if (!h5::hasAttribute(of, name)) {
    wrong(671, object, "attribute '" + name + "' is missing");
    return {};
  }
  h5::Handle attribute(H5Aopen(of, name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
  const h5::Handle space(H5Aget_space(attribute), H5Sclose, "attribute " + name);
  if (valuesOf(space) == 1) return attribute;
  wrong(671, object, "attribute '" + name + "' is not one value");
  return {};
}

std::optional<std::uint64_t> Inspection::count(const std::string& object, const std::string& name, std::uint64_t min,
                                               std::uint64_t max) {
  const auto found = attribute(object, name);
  if (!found) return {};
  const h5::Handle type(H5Aget_type(*found), H5Tclose, "attribute " + name);
  if (!isNumber(type, H5T_INTEGER) || H5Tget_sign(type) != H5T_SGN_NONE) {
    wrong(671, object, "attribute '" + name + "' is not a whole number without sign");
    return {};
  }
  std::uint64_t value = 0;
  h5::check(H5Aread(*found, H5T_NATIVE_UINT64, &value), "attribute " + name);
  if (value >= min && value <= max) return value;
  wrong(671, object,
        "attribute '" + name + "': found " + std::to_string(value) + ", allowed " + std::to_string(min) + " to " +
            std::to_string(max));
  return {};
}

double Inspection::real(const std::string& object, const std::string& name, double min, double max) {
  const auto found = attribute(object, name);
  if (!found) return std::numeric_limits<double>::quiet_NaN();
  const h5::Handle type(H5Aget_type(*found), H5Tclose, "attribute " + name);
  if (!isNumber(type, H5T_FLOAT)) {
    wrong(671, object, "attribute '" + name + "' is not a real number");
    return std::numeric_limits<double>::quiet_NaN();
  }
  double value = 0;
  h5::check(H5Aread(*found, H5T_NATIVE_DOUBLE, &value), "attribute " + name);
  if (value >= min && value <= max) return value;  // false for NaN
  wrong(
      671, object,
      "attribute '" + name + "': found " + shortText(value) + ", allowed " + shortText(min) + " to " + shortText(max));
  return std::numeric_limits<double>::quiet_NaN();
}

std::string Inspection::text(const std::string& object, const std::string& name) {
  const auto found = attribute(object, name);
  if (!found) return {};
  const h5::Handle type(H5Aget_type(*found), H5Tclose, "attribute " + name);
  if (!isFixedText(type)) {
    wrong(671, object, "attribute '" + name + "' is not a text");
    return {};
  }
  const std::size_t bytes = H5Tget_size(type);
  if (bytes > kLongestAttribute || !spend(bytes)) {
    wrong(671, object,
          "attribute '" + name + "': found " + std::to_string(bytes) + " bytes, allowed " +
              std::to_string(kLongestAttribute));
    return {};
  }
  std::string value(bytes, '\0');
  h5::check(H5Aread(*found, type, value.data()), "attribute " + name);
  value.resize(std::min(value.find('\0'), value.size()));
  return value;
}

// ---- datasets

std::string Inspection::longText(const std::string& path) {
  const auto found = dataset(path);
  if (!found) return {};
  const h5::Handle type(H5Dget_type(*found), H5Tclose, path);
  const h5::Handle space(H5Dget_space(*found), H5Sclose, path);
  if (!isFixedText(type) || valuesOf(space) != 1) {
    wrong(672, path, "is not one text");
    return {};
  }
  const std::size_t bytes = H5Tget_size(type);
  if (H5Dget_storage_size(*found) < bytes || !spend(bytes)) {
    wrong(673, path,
          "claims " + std::to_string(bytes) + " bytes of text that are not stored; the file has " +
              std::to_string(file_bytes_));
    return {};
  }
  std::string value(bytes, '\0');
  h5::check(H5Dread(*found, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), path);
  value.resize(std::min(value.find('\0'), value.size()));
  return value;
}

std::uint64_t Inspection::textCount(const std::string& path, std::uint64_t max) {
  const auto found = dataset(path);
  if (!found) return 0;
  const h5::Handle type(H5Dget_type(*found), H5Tclose, path);
  const h5::Handle space(H5Dget_space(*found), H5Sclose, path);
  const hssize_t count = valuesOf(space);
  if (!isFixedText(type) || count < 0) {
    wrong(672, path, "is not a list of texts");
    return 0;
  }
  const auto texts = static_cast<std::uint64_t>(count);
  const std::uint64_t stored = H5Dget_storage_size(*found);
  if (texts > max || stored / H5Tget_size(type) < texts || !spend(stored)) {
    wrong(673, path,
          "claims " + std::to_string(texts) + " texts of " + std::to_string(H5Tget_size(type)) + " bytes; " +
              std::to_string(stored) + " bytes are stored, at most " + std::to_string(max) + " texts are allowed");
    return 0;
  }
  return texts;
}

/// Columns are matched by name, because rows of older formats have other lengths.
bool Inspection::hasColumns(const std::string& path, hid_t dataset, const Table& columns) {
  const h5::Handle stored(H5Dget_type(dataset), H5Tclose, path);
  if (H5Tget_class(stored) != H5T_COMPOUND) {
    wrong(672, path, "is not a table of named columns");
    return false;
  }
  const std::size_t before = findings_.errorCount();
  const h5::Handle expected = h5::compoundType(columns, h5::Side::kFile);
  std::size_t bytes = 0;
  for (std::size_t c = 0; c < columns.columns.size(); ++c) {
    const std::string& name = columns.columns[c].name;
    const h5::Handle should(H5Tget_member_type(expected, static_cast<unsigned>(c)), H5Tclose, path);
    bytes += H5Tget_size(should);
    const int member = H5Tget_member_index(stored, name.c_str());
    if (member < 0) {
      wrong(672, path, "column '" + name + "' is missing");
      continue;
    }
    const h5::Handle is(H5Tget_member_type(stored, static_cast<unsigned>(member)), H5Tclose, path);
    if (H5Tequal(is, should) <= 0) wrong(672, path, "column '" + name + "' has the wrong type");
  }
  if (H5Tget_size(stored) < bytes) wrong(672, path, "its rows are shorter than their columns");
  return findings_.errorCount() == before;
}

std::optional<Inspection::Rows> Inspection::table(const std::string& path, const Table& columns, bool may_lack) {
  auto found = dataset(path);
  if (!found || !hasColumns(path, *found, columns)) return {};
  const h5::Handle properties(H5Dget_create_plist(*found), H5Pclose, path);
  hsize_t chunk = 0;
  if (H5Pget_layout(properties) != H5D_CHUNKED || H5Pget_chunk(properties, 1, &chunk) != 1 || chunk != kBlockRows) {
    wrong(670, path, "is not stored in blocks of " + std::to_string(kBlockRows) + " rows");
    return {};
  }
  const h5::Handle space(H5Dget_space(*found), H5Sclose, path);
  const hssize_t values = valuesOf(space);
  if (values < 0 || H5Sget_simple_extent_type(space) != H5S_SIMPLE) {
    wrong(672, path, "is not a list of rows");
    return {};
  }
  auto rows = static_cast<std::uint64_t>(values);
  const h5::Handle row(H5Dget_type(*found), H5Tclose, path);
  const std::uint64_t row_bytes = H5Tget_size(row), stored = H5Dget_storage_size(*found) / row_bytes;
  if (may_lack) rows = std::min(rows, stored);
  if (rows > stored || !spend(rows * row_bytes)) {
    wrong(673, path,
          "claims " + std::to_string(rows) + " rows of " + std::to_string(row_bytes) + " bytes; " +
              std::to_string(stored) + " are stored, in a file of " + std::to_string(file_bytes_) + " bytes");
    return {};
  }
  return Rows{std::move(*found), rows};
}

}  // namespace presa::record
