#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace presa::terminal {

/// During its lifetime, from two seconds on, a line on stderr says what is being waited for, and for how long: "loading
/// temple.xml, 4 s". Only on a terminal. Thread: main; it has one of its own.
class Waiting {
 public:
  explicit Waiting(std::string what);
  ~Waiting();
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  void show();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread thread_;
};

/// "loading temple.xml, 4 s", as long as `columns` allow; a name that is longer loses its beginning.
std::string waitingText(const std::string& what, int seconds, std::size_t columns);

}  // namespace presa::terminal
