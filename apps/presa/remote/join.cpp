#include "apps/presa/remote/join.h"

#include "apps/common/terminal/interruption.h"
#include "framework/core/schedule/clock.h"

namespace presa {
namespace {

/// Keeps only the static part of a run.
class AwaitRun final : public bus::Listener {
 public:
  void onRun(const bus::RunInfo& announced, std::int64_t) override { run = announced; }
  void onObject(const bus::ObjectSample&, std::int64_t) override {}
  void onFinger(const bus::FingerSample&, std::int64_t) override {}
  void onHeartbeat(const bus::Heartbeat&, std::int64_t) override {}
  void onEvent(const bus::Event&, std::int64_t) override {}
  std::optional<bus::RunInfo> run;
};

}  // namespace

std::optional<bus::RunInfo> awaitRun(bus::Reader& reader, double seconds) {
  AwaitRun await;
  const std::int64_t end = monotonicNs() + static_cast<std::int64_t>(seconds * 1e9);
  do {
    reader.wait(0.05);
    reader.take(await);
  } while (!await.run && monotonicNs() < end && !terminal::Interruption::came());
  return await.run;
}

}  // namespace presa
