#pragma once
#include <string>

namespace presa::sound {

/// A module that writes what is heard to the file of RunOptions::sound. Thread: main, after the run.
class SoundOutput {
 public:
  virtual ~SoundOutput() = default;
  /// Why there is no such file; empty: it was written, or none was asked for.
  virtual std::string trouble() const = 0;
};

}  // namespace presa::sound
