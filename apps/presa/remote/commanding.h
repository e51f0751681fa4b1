#pragma once
#include <string>
#include <vector>

#include "framework/bus/state_bus.h"

namespace presa {

/// A run on the bus, and what of it may be set, by name.
struct FoundRun {
  bus::RunInfo info;
  std::vector<bus::OpenParameter> parameters;
};

/// Whoever lists runs or sets parameters, on one network. Thread: main. Ends early on Ctrl-C (terminal::Interruption).
class Commanding {
 public:
  /// Throws InputError as openReader does.
  explicit Commanding(const BusSettings& settings);

  /// By id. Looks for runs until nothing new has come for a moment, at most `wait` seconds. `id`: until that one is there; 0: any.
  const std::vector<FoundRun>& look(double wait, std::uint64_t id);
  /// Sends it again and again until it is answered, at most `wait` seconds; none then, or on Ctrl-C.
  std::optional<bus::Answer> set(std::uint64_t run, const std::string& parameter, double value, double wait);

 private:
  void hear();

  std::unique_ptr<bus::Reader> reader_;
  std::unique_ptr<bus::Commander> commander_;
  std::vector<FoundRun> runs_;
  std::vector<bus::OpenParameter> parameters_;
  std::vector<bus::Answer> answers_;
  std::int64_t news_ns_ = 0;
  std::uint64_t sender_, sent_ = 0;
};

/// As people write it: 16 digits, hexadecimal. `runFrom`: 0 when it is none.
std::string textOfRun(std::uint64_t run);
std::uint64_t runFrom(const std::string& text);

}  // namespace presa
