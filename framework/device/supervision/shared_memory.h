#pragma once
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>
#include <utility>

namespace presa {

/// One T in memory that two processes share; freed when both have unmapped it. Throws std::system_error.
template <class T>
class SharedMemory {
 public:
  /// Allocates the memory and constructs a T in it. Pass fd() to the other process; it is closed on exec otherwise.
  static SharedMemory made(const char* name) {
    const int fd = memfd_create(name, MFD_CLOEXEC);
    if (fd < 0 || ftruncate(fd, sizeof(T)) != 0) fail("shared memory");
    SharedMemory memory(fd);
    new (memory.mapped_) T;
    return memory;
  }
  /// Maps the memory in the other process.
  static SharedMemory joined(int fd) { return SharedMemory(fd); }

  SharedMemory() = default;  ///< empty
  /// `other` is empty afterwards.
  SharedMemory(SharedMemory&& other) noexcept
      : fd_(std::exchange(other.fd_, -1)), mapped_(std::exchange(other.mapped_, nullptr)) {}
  /// Exchanges the two.
  SharedMemory& operator=(SharedMemory&& other) noexcept {
    std::swap(fd_, other.fd_);
    std::swap(mapped_, other.mapped_);
    return *this;
  }
  ~SharedMemory() {
    if (mapped_ != nullptr) munmap(mapped_, sizeof(T));
    if (fd_ >= 0) ::close(fd_);
  }

  explicit operator bool() const noexcept { return mapped_ != nullptr; }  ///< holds memory
  T& operator*() const noexcept { return *mapped_; }                      ///< not empty
  T* operator->() const noexcept { return mapped_; }                      ///< not empty
  int fd() const noexcept { return fd_; }                                 ///< file of the memory; -1: empty

 private:
  explicit SharedMemory(int fd) : fd_(fd) {
    void* address = mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, fd, 0);
    if (address == MAP_FAILED) fail("shared memory");
    mapped_ = static_cast<T*>(address);
  }
  [[noreturn]] static void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

  int fd_ = -1;
  T* mapped_ = nullptr;
};

}  // namespace presa
