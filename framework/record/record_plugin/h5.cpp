#include "framework/record/record_plugin/h5.h"

#include <algorithm>

namespace presa::record::h5 {
namespace {

std::mutex& libraryMutex() {
  static std::mutex mutex;
  return mutex;
}

Handle stringType(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "string type");
  check(H5Tset_size(type, std::max<std::size_t>(length, 1)), "string length");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "string padding");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "string encoding");
  return type;
}

struct Texts {
  Handle type;
  Handle space;
  std::string bytes;
};

Texts pack(const std::vector<std::string>& values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  const hsize_t count = values.size();
  Texts texts{stringType(length), Handle(H5Screate_simple(1, &count, nullptr), H5Sclose, "string space"), {}};
  for (std::string value : values) {
    value.resize(length, '\0');
    texts.bytes += value;
  }
  if (texts.bytes.empty()) texts.bytes.resize(1);
  return texts;
}

void writeRawAttribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type, hid_t space,
                       const void* value) {
  const Handle attribute(H5Aexists(object, name.c_str()) > 0
                             ? H5Aopen(object, name.c_str(), H5P_DEFAULT)
                             : H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, "attribute " + name);
  check(H5Awrite(attribute, memory_type, value), "attribute " + name);
}

Handle scalar() { return {H5Screate(H5S_SCALAR), H5Sclose, "scalar space"}; }

void readScalarAttribute(hid_t object, const std::string& name, hid_t memory_type, void* value) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
  const Handle space(H5Aget_space(attribute), H5Sclose, "attribute " + name);
  if (H5Sget_simple_extent_npoints(space) != 1) throw Failure("attribute " + name + " is not one value");
  check(H5Aread(attribute, memory_type, value), "attribute " + name);
}

/// A buffer for a fixed-length string of this type.
std::string textBuffer(hid_t type, const std::string& name) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) throw Failure(name + " is not a text");
  return std::string(H5Tget_size(type), '\0');
}

std::string trimmed(std::string text) {
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

hid_t cellType(Cell cell, Side side) {
  const bool file = side == Side::kFile;
  switch (cell) {
    case Cell::kU64:
      return file ? H5T_STD_U64LE : H5T_NATIVE_UINT64;
    case Cell::kF64:
      return file ? H5T_IEEE_F64LE : H5T_NATIVE_DOUBLE;
    case Cell::kI32:
      return file ? H5T_STD_I32LE : H5T_NATIVE_INT32;
    case Cell::kU32:
      return file ? H5T_STD_U32LE : H5T_NATIVE_UINT32;
  }
  return -1;
}

}  // namespace

Library::Library() : lock_(libraryMutex()) {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle::Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
  if (id < 0) throw Failure(what);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this == &other) return *this;
  reset();
  id_ = std::exchange(other.id_, -1);
  close_ = other.close_;
  return *this;
}

bool Handle::reset() noexcept {
  const hid_t id = std::exchange(id_, -1);
  return id < 0 || close_(id) >= 0;
}

void check(herr_t status, const std::string& what) {
  if (status < 0) throw Failure(what);
}

Handle compoundType(const Table& table, Side side) {
  Handle type(H5Tcreate(H5T_COMPOUND, table.row_bytes), H5Tclose, "row type");
  for (const Column& column : table.columns) {
    check(H5Tinsert(type, column.name.c_str(), column.offset, cellType(column.cell, side)), "column " + column.name);
  }
  return type;
}

Handle group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "group " + name};
}

void writeAttribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type = stringType(value.size());
  writeRawAttribute(object, name, type, type, scalar(), value.c_str());
}

void writeAttribute(hid_t object, const std::string& name, const std::vector<std::string>& values) {
  const Texts texts = pack(values);
  writeRawAttribute(object, name, texts.type, texts.type, texts.space, texts.bytes.data());
}

void writeAttribute(hid_t object, const std::string& name, double value) {
  writeRawAttribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar(), &value);
}

void writeAttribute(hid_t object, const std::string& name, std::uint64_t value) {
  writeRawAttribute(object, name, H5T_STD_U64LE, H5T_NATIVE_UINT64, scalar(), &value);
}

void writeText(hid_t parent, const std::string& name, const std::string& text) {
  const Handle type = stringType(text.size());
  const Handle dataset(H5Dcreate2(parent, name.c_str(), type, scalar(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose, "text " + name);
  check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), "text " + name);
}

void writeTexts(hid_t parent, const std::string& name, const std::vector<std::string>& texts) {
  const Texts packed = pack(texts);
  const Handle dataset(
      H5Dcreate2(parent, name.c_str(), packed.type, packed.space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
      "texts " + name);
  check(H5Dwrite(dataset, packed.type, H5S_ALL, H5S_ALL, H5P_DEFAULT, packed.bytes.data()), "texts " + name);
}

bool hasAttribute(hid_t object, const std::string& name) { return H5Aexists(object, name.c_str()) > 0; }

std::string readStringAttribute(hid_t object, const std::string& name) {
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose, "attribute " + name);
  const Handle type(H5Aget_type(attribute), H5Tclose, "attribute " + name);
  const Handle space(H5Aget_space(attribute), H5Sclose, "attribute " + name);
  if (H5Sget_simple_extent_npoints(space) != 1) throw Failure("attribute " + name + " is not one value");
  std::string text = textBuffer(type, name);
  check(H5Aread(attribute, type, text.data()), "attribute " + name);
  return trimmed(std::move(text));
}

double readRealAttribute(hid_t object, const std::string& name) {
  double value = 0;
  readScalarAttribute(object, name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::uint64_t readCountAttribute(hid_t object, const std::string& name) {
  std::uint64_t value = 0;
  readScalarAttribute(object, name, H5T_NATIVE_UINT64, &value);
  return value;
}

std::string readText(hid_t parent, const std::string& name) {
  const Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "text " + name);
  const Handle type(H5Dget_type(dataset), H5Tclose, "text " + name);
  const Handle space(H5Dget_space(dataset), H5Sclose, "text " + name);
  if (H5Sget_simple_extent_npoints(space) != 1) throw Failure(name + " is not one text");
  std::string text = textBuffer(type, name);
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "text " + name);
  return trimmed(std::move(text));
}

std::vector<std::string> members(hid_t group) {
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names), "members of a group");
  return names;
}

}  // namespace presa::record::h5
