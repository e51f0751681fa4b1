#pragma once
#include <sys/types.h>

#include <string>
#include <utility>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::temple {

/// Reads sentences aloud through espeak-ng, a program of its own, one at a time: a new sentence interrupts the last one.
/// Thread: main.
class Voice {
 public:
  /// `language`: two letters.
  explicit Voice(std::string language) : language_(std::move(language)) {}
  ~Voice();
  Voice(const Voice&) = delete;
  Voice& operator=(const Voice&) = delete;

  /// E965: espeak-ng is not installed.
  static void check(Diagnostics& diagnostics);
  /// Says a sentence; does nothing for the one that was said last, or for none.
  void say(const std::string& sentence);

 private:
  void stop();

  const std::string language_;
  std::string said_;
  pid_t speaker_ = -1;
};

}  // namespace presa::temple
