#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "framework/record/record_plugin/h5.h"
#include "framework/record/record_plugin/recording_file.h"

namespace presa::record {

/// A recording of a format that this version knows, else InputError as RecordPlugin::read.
h5::Handle openRecording(const std::string& file);

/// What went wrong in the run, with times, in words.
std::vector<std::string> readFaults(hid_t file);

/// A dataset of the group haptic/NAME and what it is called.
struct HapticTable {
  std::string name;
  h5::Handle dataset;
};
/// Finger tables in the order of the device roles, body tables in that of the scene.
std::vector<HapticTable> hapticTables(hid_t file, const std::string& group, const std::string& number);

/// The rows of a table that can be read, in order. In the file of a killed run the newest chunk may be unreadable
/// (its flush was cut short): the table ends before it, and before the first row whose index does not grow.
template <class Row>
std::vector<Row> readRows(hid_t dataset, const Table& columns) {
  const h5::Handle type = h5::compoundType(columns, h5::Side::kMemory);
  const h5::Handle stored(H5Dget_type(dataset), H5Tclose, "row type");
  for (const Column& column : columns.columns) {
    if (H5Tget_class(stored) != H5T_COMPOUND || H5Tget_member_index(stored, column.name.c_str()) < 0) {
      throw h5::Failure("column " + column.name + " is missing");
    }
  }
  const h5::Handle space(H5Dget_space(dataset), H5Sclose, "table space");
  const hssize_t total = H5Sget_simple_extent_npoints(space);
  if (H5Sget_simple_extent_ndims(space) != 1 || total < 0) throw h5::Failure("a table is not a list of rows");

  std::vector<Row> rows;
  rows.reserve(static_cast<std::size_t>(total));
  for (hsize_t begin = 0; begin < static_cast<hsize_t>(total);) {
    const hsize_t length = std::min<hsize_t>(kBlockRows, static_cast<hsize_t>(total) - begin);
    h5::check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &begin, nullptr, &length, nullptr), "table selection");
    const h5::Handle memory(H5Screate_simple(1, &length, nullptr), H5Sclose, "row space");
    rows.resize(begin + length);
    if (H5Dread(dataset, type, memory, space, H5P_DEFAULT, &rows[begin]) < 0) {
      rows.resize(begin);
      break;
    }
    begin += length;
  }
  const auto out_of_order = [](const Row& a, const Row& b) { return a.index >= b.index; };
  const auto last = std::adjacent_find(rows.begin(), rows.end(), out_of_order);
  if (last != rows.end()) rows.erase(last + 1, rows.end());
  return rows;
}

template <class Row>
std::vector<Row> readTable(hid_t parent, const std::string& name, const Table& columns) {
  const h5::Handle dataset(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "table " + name);
  return readRows<Row>(dataset, columns);
}

}  // namespace presa::record
