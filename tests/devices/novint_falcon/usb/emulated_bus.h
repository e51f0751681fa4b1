#pragma once
#include <pthread.h>
#include <umockdev.h>

#include <chrono>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "devices/falcon_model/falcon_model.h"

namespace presa::falcon_model::test {

/// Owning reference to a glib object.
template <class T>
struct Unref {
  void operator()(T* object) const { g_object_unref(object); }
};
template <class T>
using Object = std::unique_ptr<T, Unref<T>>;

/// A mutex with priority inheritance: a test that inspects a model must not delay its device.
class UrgentMutex {
 public:
  UrgentMutex() {
    pthread_mutexattr_t attributes;
    pthread_mutexattr_init(&attributes);
    pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    pthread_mutex_init(&mutex_, &attributes);
    pthread_mutexattr_destroy(&attributes);
  }
  ~UrgentMutex() { pthread_mutex_destroy(&mutex_); }
  UrgentMutex(const UrgentMutex&) = delete;
  UrgentMutex& operator=(const UrgentMutex&) = delete;
  void lock() { pthread_mutex_lock(&mutex_); }
  void unlock() { pthread_mutex_unlock(&mutex_); }

 private:
  pthread_mutex_t mutex_{};
};

/// A Falcon on an emulated USB port. Its model runs in real time: seconds of the steady clock since the bus was
/// created. Thread: any; a lock protects the model.
class EmulatedFalcon {
 public:
  /// `port`: port on bus 1, also the device's address. Plugged in at construction.
  EmulatedFalcon(UMockdevTestbed* testbed, int port, ModelSettings settings,
                 std::chrono::steady_clock::time_point epoch);
  ~EmulatedFalcon();
  EmulatedFalcon(const EmulatedFalcon&) = delete;
  EmulatedFalcon& operator=(const EmulatedFalcon&) = delete;

  /// Calls f(model, now), the model advanced to now, and returns what it returns.
  template <class F>
  auto with(F f) {
    const std::lock_guard lock(mutex_);
    const double time = now();
    model_.advance(time);
    return f(model_, time);
  }

  /// Unplugs: transfers end, the device node disappears, the system is notified.
  void unplug();
  void plug();
  /// Makes the device refuse all bulk transfers (EPIPE).
  void stallBulk(bool stalled);
  std::string port() const { return "1-" + std::to_string(port_); }  ///< in the system's notation
  double now() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - epoch_).count(); }

 private:
  struct Urb {
    Object<UMockdevIoctlData> urb, buffer;
    UMockdevIoctlClient* client = nullptr;
    double submitted = 0;
    std::vector<WireByte> brings{};  // after completion; the model learns of it when the host fetches it
  };
  static gboolean handle(UMockdevIoctlBase* base, UMockdevIoctlClient* client, EmulatedFalcon* self);
  bool ioctl(UMockdevIoctlClient* client);
  void releaseIfGone();
  void claim(UMockdevIoctlClient* client);
  void submit(UMockdevIoctlClient* client);
  void reap(UMockdevIoctlClient* client);
  void discard(UMockdevIoctlClient* client);
  void control(Urb urb);
  void pump();
  void finish(Urb urb, int status, int length);
  void addToSystem();

  UMockdevTestbed* testbed_;
  int port_;
  std::chrono::steady_clock::time_point epoch_;
  std::string node_, path_;
  Object<UMockdevIoctlBase> base_;
  UrgentMutex mutex_;
  FalconModel model_;
  Object<UMockdevIoctlClient> owner_;  // the client that has claimed the interface
  bool gone_ = false, stalled_ = false;
  std::deque<Urb> in_, out_, done_;
};

/// The bus, visible to programs under umockdev-wrapper in this process or started by it. One at a time.
class EmulatedBus {
 public:
  EmulatedBus();
  /// Adds a device at the next port.
  EmulatedFalcon& add(ModelSettings settings);

 private:
  Object<UMockdevTestbed> testbed_;
  std::chrono::steady_clock::time_point epoch_ = std::chrono::steady_clock::now();
  std::vector<std::unique_ptr<EmulatedFalcon>> falcons_;
};

}  // namespace presa::falcon_model::test
