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

/// A reference to an object of glib.
template <class T>
struct Unref {
  void operator()(T* object) const { g_object_unref(object); }
};
template <class T>
using Object = std::unique_ptr<T, Unref<T>>;

/// Whoever holds it is as urgent as whoever waits for it: a test that looks at a model must not hold up its device.
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

/// A Falcon on an emulated USB port. Its model lives in real time: seconds of the steady clock since the bus was made.
/// Thread: any; a lock is held while the model is touched.
class EmulatedFalcon {
 public:
  /// `port`: of bus 1, and the device's address there. Plugged in at once.
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

  /// Pulled out: transfers end, the node goes, the system is told.
  void unplug();
  void plug();
  /// All transfers of data are refused by the device (EPIPE) from now on.
  void stallBulk(bool stalled);
  std::string port() const { return "1-" + std::to_string(port_); }  ///< as the system calls it
  double now() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - epoch_).count(); }

 private:
  struct Urb {
    Object<UMockdevIoctlData> urb, buffer;
    UMockdevIoctlClient* client = nullptr;
    double submitted = 0;
    std::vector<WireByte> brings{};  // once it has ended; the model learns of it when the host fetches it
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
  Object<UMockdevIoctlClient> owner_;  // who has claimed the interface
  bool gone_ = false, stalled_ = false;
  std::deque<Urb> in_, out_, done_;
};

/// The bus: enumerated by whatever program runs under umockdev-wrapper in this process or is started by it. One at a time.
class EmulatedBus {
 public:
  EmulatedBus();
  /// The next port.
  EmulatedFalcon& add(ModelSettings settings);

 private:
  Object<UMockdevTestbed> testbed_;
  std::chrono::steady_clock::time_point epoch_ = std::chrono::steady_clock::now();
  std::vector<std::unique_ptr<EmulatedFalcon>> falcons_;
};

}  // namespace presa::falcon_model::test
