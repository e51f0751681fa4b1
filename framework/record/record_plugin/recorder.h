#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/record/record_plugin/row_ring.h"
#include "framework/record/record_plugin/row_sink.h"
#include "framework/record/recording.h"
#include "framework/scene/frame_state.h"
#include "framework/scene/guide_orders.h"
#include "framework/scene/surface_change.h"
#include "framework/scene/surface_settings.h"

namespace presa::record {

/// Writer intervals, and hooks for tests (called on the writer's thread).
struct WriterSettings {
  std::chrono::milliseconds look_every{100};
  std::chrono::milliseconds flush_every{800};
  std::function<void()> before_round;
  std::function<void(std::uint64_t flushed_ticks)> after_flush;
};

/// Records into options.record, or, when only options.flight is set, keeps a flight recording for faults.
/// Two threads: step() runs on the haptic thread and puts rows into a ring; the writer, an ordinary thread, drains the
/// ring and is, between construction and finish(), the only thread that touches the file.
class FileRecorder final : public Recorder {
 public:
  FileRecorder(std::shared_ptr<const World> world, const RunOptions& options, const RecordedDevices& devices,
               WriterSettings settings = {});
  ~FileRecorder() override;

  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override;
  void attach(ScheduleLog& schedule) override { schedule_.store(&schedule, std::memory_order_release); }
  void fault(double time, const std::string& what) override;
  void finish() override;
  std::vector<std::string> files() const override { return files_; }
  RecorderStatus status() const noexcept override;

  /// Capacity of the ring in rows.
  std::size_t capacity() const noexcept { return capacity_; }

 private:
  void fillRow(const Tick& tick) noexcept;
  void handOver() noexcept;
  void fillFinger(std::size_t finger, const Tick& tick) noexcept;
  void fillBody(std::size_t slot, const Tick& tick) noexcept;
  void fillTool(std::size_t slot, const Tick& tick) noexcept;
  void fillFrame(std::size_t frame, const Tick& tick) noexcept;
  void fillOrder(const Tick& tick) noexcept;
  template <class Row>
  void put(std::size_t offset, const Row& row) noexcept;
  void hurryWriter() noexcept;
  void waitForSpace() noexcept;

  void startWriter();
  void joinWriter();
  void write();
  void drain();
  std::size_t drainBlock();
  void drainSchedule();
  void writeFaults();
  void flushWhenDue();
  void closeFile();
  template <class Work>
  void onFile(const Work& work);
  std::uint64_t lostInRings() const noexcept;

  In<DeviceState> device_{*this, "device_state", In<DeviceState>::Optional{}};
  In<ContactExchange> contact_{*this, "contact_exchange", In<ContactExchange>::Optional{}};
  In<ForceCommand> command_{*this, "force_command", In<ForceCommand>::Optional{}};
  In<ObjectState> objects_{*this, "object_state", In<ObjectState>::Optional{}};
  In<ObjectState> shown_{*this, kShownObjectsPort, In<ObjectState>::Optional{}};
  In<SurfaceChange> surfaces_{*this, "surface_change", In<SurfaceChange>::Optional{}};
  std::optional<In<FrameState>> frames_;          // only when the rig has frames
  std::optional<In<SurfaceSettings>> commanded_;  // only when the run takes commands
  SettingsTaker commands_;
  std::optional<In<TakenOrders>> ordered_;  // only when the guide is in a viewer
  OrderTaker orders_;

  std::shared_ptr<const World> world_;
  WriterSettings settings_;
  const bool realtime_;
  std::unique_ptr<RowSink> file_;
  RowLayout layout_;
  std::vector<std::int32_t> free_bodies_;  ///< scene indices, in the order of the body tables
  std::size_t capacity_;
  RowRing ring_;
  std::vector<std::uint64_t> row_;    ///< haptic thread: the row being filled
  std::vector<std::uint64_t> block_;  ///< writer: rows taken from the ring
  std::vector<ScheduleRow> schedule_block_;
  bool inputs_named_ = false;  ///< writer
  std::chrono::steady_clock::time_point flushed_at_;
  std::atomic<ScheduleLog*> schedule_{nullptr};

  std::atomic<std::uint64_t> accepted_{0};
  std::atomic<std::uint64_t> dropped_{0};
  std::atomic<std::uint64_t> kept_{0};  ///< ticks in the file at the time of the failure
  std::atomic<bool> failed_{false};

  std::mutex mutex_;
  std::condition_variable wake_;   ///< the writer waits
  std::condition_variable space_;  ///< step() waits, in lockstep only
  std::atomic<bool> hurry_{false};
  std::vector<std::string> faults_;  ///< not yet taken by the writer
  std::size_t faults_unwritten_ = 0;
  bool stop_ = false;
  bool complete_ = false;
  std::vector<std::string> files_;  ///< valid after finish()
  std::thread writer_;
};

}  // namespace presa::record
