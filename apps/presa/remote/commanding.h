#pragma once
#include <string>
#include <vector>

#include "framework/bus/state_bus.h"

namespace presa {

/// A run on the bus and its settable parameters, sorted by name.
struct FoundRun {
  bus::RunInfo info;
  std::vector<bus::OpenParameter> parameters;
};

/// Lists runs on one network and sets their parameters. Thread: main. Its calls end early on Ctrl-C
/// (terminal::Interruption).
class Commanding {
 public:
  /// Throws InputError as openReader does.
  explicit Commanding(const BusSettings& settings);

  /// The runs, sorted by id. Waits at most `wait` seconds, until run `id` is found or, for id 0, no new run has come
  /// for a moment.
  const std::vector<FoundRun>& look(double wait, std::uint64_t id);
  /// Sends the command repeatedly until it is answered; none after `wait` seconds or on Ctrl-C.
  std::optional<bus::Answer> set(std::uint64_t run, const std::string& parameter, double value, double wait);

 private:
  void hear();

  std::unique_ptr<bus::Reader> reader_;
  std::unique_ptr<bus::Commander> commander_;
  std::vector<FoundRun> runs_;
  std::vector<bus::OpenParameter> parameters_;
  std::vector<bus::Answer> answers_;
  std::int64_t last_run_found_ns_ = 0;
  std::uint64_t sender_, sent_ = 0;
};

/// The id of a run as text: 16 hexadecimal digits. `runFrom`: 0 if the text is no such id.
std::string textOfRun(std::uint64_t run);
std::uint64_t runFrom(const std::string& text);

}  // namespace presa
