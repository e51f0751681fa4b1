#include "tests/framework/record/damage.h"

#include <vector>

namespace presa::record {
namespace {

h5::Handle list(hsize_t rows, hsize_t max) { return {H5Screate_simple(1, &rows, &max), H5Sclose, "rows"}; }

h5::Handle creation() { return {H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties"}; }

}  // namespace

Damage::Damage(const std::string& file) : file_(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, file) {}

h5::Handle Damage::object(const std::string& path) const {
  return {H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose, path};
}

h5::Handle Damage::table(const std::string& path) const {
  return {H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose, path};
}

std::uint64_t Damage::rowsOf(const std::string& path) const {
  const h5::Handle space(H5Dget_space(table(path)), H5Sclose, path);
  return static_cast<std::uint64_t>(H5Sget_simple_extent_npoints(space));
}

void Damage::writeCells(const std::string& path, const std::string& column, const h5::Handle& space, hid_t cell,
                        const void* values) {
  const h5::Handle type(H5Tcreate(H5T_COMPOUND, H5Tget_size(cell)), H5Tclose, column);
  h5::check(H5Tinsert(type, column.c_str(), 0, cell), column);
  const hsize_t count = static_cast<hsize_t>(H5Sget_select_npoints(space));
  const h5::Handle memory = list(count, count);
  h5::check(H5Dwrite(table(path), type, memory, space, H5P_DEFAULT, values), path);
}

void Damage::cell(const std::string& path, const std::string& column, std::uint64_t row, double value) {
  const h5::Handle space(H5Dget_space(table(path)), H5Sclose, path);
  const hsize_t begin = row, one = 1;
  h5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &one, nullptr), path);
  writeCells(path, column, space, H5T_NATIVE_DOUBLE, &value);
}

void Damage::cell(const std::string& path, const std::string& column, std::uint64_t row, std::int64_t value) {
  const h5::Handle space(H5Dget_space(table(path)), H5Sclose, path);
  const hsize_t begin = row, one = 1;
  h5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &one, nullptr), path);
  writeCells(path, column, space, H5T_NATIVE_INT64, &value);
}

void Damage::everyCell(const std::string& path, const std::string& column, std::int64_t value) {
  const h5::Handle space(H5Dget_space(table(path)), H5Sclose, path);
  const std::vector<std::int64_t> values(rowsOf(path), value);
  writeCells(path, column, space, H5T_NATIVE_INT64, values.data());
}

void Damage::rows(const std::string& path, std::uint64_t rows) {
  const hsize_t count = rows;
  h5::check(H5Dset_extent(table(path), &count), path);
}

void Damage::attribute(const std::string& path, const std::string& name, std::uint64_t value) {
  dropAttribute(path, name);
  h5::writeAttribute(object(path), name, value);
}

void Damage::attribute(const std::string& path, const std::string& name, double value) {
  dropAttribute(path, name);
  h5::writeAttribute(object(path), name, value);
}

void Damage::attribute(const std::string& path, const std::string& name, const std::string& value) {
  dropAttribute(path, name);
  h5::writeAttribute(object(path), name, value);
}

void Damage::dropAttribute(const std::string& path, const std::string& name) {
  const h5::Handle of = object(path);
  if (h5::hasAttribute(of, name)) h5::check(H5Adelete(of, name.c_str()), name);
}

void Damage::dropLink(const std::string& path) { h5::check(H5Ldelete(file_, path.c_str(), H5P_DEFAULT), path); }

void Damage::externalLink(const std::string& path, const std::string& file, const std::string& target) {
  dropLink(path);
  h5::check(H5Lcreate_external(file.c_str(), target.c_str(), file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT), path);
}

void Damage::softLink(const std::string& path, const std::string& target) {
  dropLink(path);
  h5::check(H5Lcreate_soft(target.c_str(), file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT), path);
}

void Damage::hardLink(const std::string& path, const std::string& target) {
  h5::check(H5Lcreate_hard(file_, target.c_str(), file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT), path);
}

/// Replaces a dataset. Of its attributes only the number of the finger or body is kept.
h5::Handle Damage::replace(const std::string& path, const h5::Handle& space, const h5::Handle& properties) {
  const h5::Handle old = table(path);
  const h5::Handle type(H5Dget_type(old), H5Tclose, path);
  dropLink(path);
  h5::Handle made(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, path);
  for (const char* place : {"finger", "body"})
    if (h5::hasAttribute(old, place)) h5::writeAttribute(made, place, h5::readCountAttribute(old, place));
  return made;
}

void Damage::virtualTable(const std::string& path, const std::string& file, const std::string& source) {
  const hsize_t rows = rowsOf(path);
  const h5::Handle space = list(rows, rows), properties = creation();
  h5::check(H5Pset_virtual(properties, space, file.c_str(), source.c_str(), space), path);
  replace(path, space, properties);
}

void Damage::externallyStored(const std::string& path, const std::string& file) {
  const hsize_t rows = rowsOf(path);
  const h5::Handle space = list(rows, rows), properties = creation();
  h5::check(H5Pset_external(properties, file.c_str(), 0, H5F_UNLIMITED), path);
  replace(path, space, properties);
}

void Damage::unallocated(const std::string& path, std::uint64_t rows) {
  const h5::Handle space = list(rows, H5S_UNLIMITED), properties = creation();
  const hsize_t chunk = 1024;
  h5::check(H5Pset_chunk(properties, 1, &chunk), path);
  replace(path, space, properties);
}

void Damage::filtered(const std::string& path, int filter) {
  const h5::Handle space = list(rowsOf(path), H5S_UNLIMITED), properties = creation();
  const hsize_t chunk = 1024;
  h5::check(H5Pset_chunk(properties, 1, &chunk), path);
  h5::check(H5Pset_filter(properties, filter, H5Z_FLAG_OPTIONAL, 0, nullptr), path);
  replace(path, space, properties);
}

void Damage::chunked(const std::string& path, std::uint64_t rows_of_a_chunk) {
  const h5::Handle space = list(rowsOf(path), H5S_UNLIMITED), properties = creation();
  const hsize_t chunk = rows_of_a_chunk;
  h5::check(H5Pset_chunk(properties, 1, &chunk), path);
  replace(path, space, properties);
}

void Damage::hugeText(const std::string& path, std::uint64_t bytes) {
  dropLink(path);
  const h5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, path);
  h5::check(H5Tset_size(type, bytes), path);
  const h5::Handle space(H5Screate(H5S_SCALAR), H5Sclose, path);
  const h5::Handle made(H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
                        path);
}

}  // namespace presa::record
