#pragma once
#define H5_USE_110_API  // of Debian 12; later releases have it, too
#include <hdf5.h>

#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "framework/record/record_plugin/rows.h"

/// Thin wrapper over the part of HDF5 that recordings use: owning handles, errors as exceptions.
namespace presa::record::h5 {

class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Lock that every caller of HDF5 must hold, because the library is not thread-safe. The constructor also turns off
/// HDF5's error output on stderr (a per-thread setting) and its clean-up at exit, which would retry, and print, writes
/// that failed on a full disk.
class Library {
 public:
  Library();

 private:
  std::scoped_lock<std::mutex> lock_;
};

class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  /// Takes ownership of `id`; throws Failure(what) when it is not valid.
  Handle(hid_t id, Close close, const std::string& what);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }
  operator hid_t() const noexcept { return id_; }
  /// Closes the handle. False when that failed: data that were not flushed may be lost.
  bool reset() noexcept;

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Throws Failure(what) when `status` is an error.
void check(herr_t status, const std::string& what);

enum class Side { kFile, kMemory };
/// Compound type of a table: little-endian IEEE in the file, native in memory.
Handle compoundType(const Table& table, Side side);

Handle group(hid_t parent, const std::string& name);
/// Fixed-length UTF-8 strings: read by h5py, MATLAB and R without variable-length support.
void writeAttribute(hid_t object, const std::string& name, const std::string& value);
void writeAttribute(hid_t object, const std::string& name, const std::vector<std::string>& values);
void writeAttribute(hid_t object, const std::string& name, double value);
void writeAttribute(hid_t object, const std::string& name, std::uint64_t value);
/// A text as a dataset, because an attribute holds at most 64 kB.
void writeText(hid_t parent, const std::string& name, const std::string& text);
void writeTexts(hid_t parent, const std::string& name, const std::vector<std::string>& texts);

bool hasAttribute(hid_t object, const std::string& name);
std::string readStringAttribute(hid_t object, const std::string& name);
double readRealAttribute(hid_t object, const std::string& name);
std::uint64_t readCountAttribute(hid_t object, const std::string& name);
std::string readText(hid_t parent, const std::string& name);
/// Names of a group's members.
std::vector<std::string> members(hid_t group);

}  // namespace presa::record::h5
