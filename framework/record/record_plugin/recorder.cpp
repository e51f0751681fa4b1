#include "framework/record/record_plugin/recorder.h"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

#include "framework/core/schedule/rates.h"
#include "framework/record/record_plugin/flight_buffer.h"
#include "framework/scene/pose_of.h"

namespace presa::record {
namespace {

/// Four seconds of rows, at most 16384 (half the capacity of a schedule ring) and 256 MB.
std::size_t ringRows(const World& world, std::size_t row_bytes) {
  const double rate = RateTable(world.scene.rates).rate(RateGroup::kHaptic);
  const auto four_seconds = static_cast<std::size_t>(std::clamp(4 * rate, 256.0, 16384.0));
  return std::min(four_seconds, (std::size_t{256} << 20) / row_bytes);
}

std::vector<std::int32_t> freeBodies(const Scene& scene) {
  std::vector<std::int32_t> indices;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!scene.bodies[b].fixed) indices.push_back(static_cast<std::int32_t>(b));
  }
  return indices;
}

std::unique_ptr<RowSink> createSink(const std::shared_ptr<const World>& world, const RunOptions& options,
                                    const RecordedDevices& devices) {
  const h5::Library library;
  if (options.record.empty()) return std::make_unique<FlightBuffer>(world, options, devices);
  return std::make_unique<RecordingFile>(*world, options, devices);
}

void copy(const Vec3& from, double (&to)[3]) noexcept { std::copy_n(from.data(), 3, to); }
void copy(const Quat& from, double (&to)[4]) noexcept {
  to[0] = from.w(), to[1] = from.x(), to[2] = from.y(), to[3] = from.z();
}

}  // namespace

FileRecorder::FileRecorder(std::shared_ptr<const World> world, const RunOptions& options,
                           const RecordedDevices& devices, WriterSettings settings)
    : Recorder("record", RateGroup::kHaptic),
      world_(std::move(world)),
      settings_(std::move(settings)),
      realtime_(options.realtime),
      file_(createSink(world_, options, devices)),
      layout_(file_->layout()),
      free_bodies_(freeBodies(world_->scene)),
      capacity_(ringRows(*world_, layout_.bytes())),
      ring_(layout_.words(), capacity_),
      row_(layout_.words()),
      block_(layout_.words() * std::min(kBlockRows, capacity_)),
      schedule_block_(kBlockRows),
      flushed_at_(std::chrono::steady_clock::now()) {
  if (layout_.frames > 0) frames_.emplace(*this, kFramesPort, In<FrameState>::Optional{});
  if (layout_.orders) ordered_.emplace(*this, kTakenOrdersPort, In<TakenOrders>::Optional{});
  if (options.bus_commands) commanded_.emplace(*this, "surface_settings", In<SurfaceSettings>::Optional{});
  startWriter();
}

FileRecorder::~FileRecorder() { joinWriter(); }

std::vector<std::string> FileRecorder::stages() const {
  return {"gather device state, contacts, forces and the poses at this tick into one row",
          realtime_ ? "hand the row to the writer thread, or drop and count it when the disk is 4 s behind"
                    : "hand the row to the writer thread, waiting for the disk when it is behind"};
}

// ---- haptic thread

template <class Row>
void FileRecorder::put(std::size_t offset, const Row& row) noexcept {
  std::memcpy(reinterpret_cast<std::byte*>(row_.data()) + offset, &row, sizeof row);
}

void FileRecorder::step(const Tick& tick) noexcept {
  fillRow(tick);
  handOver();
}

void FileRecorder::handOver() noexcept {
  if (!realtime_) {
    // also keeps the schedule rings from overflowing: they hold twice as many rows and are drained as often
    if (ring_.crowded()) hurryWriter();
    if (ring_.full()) waitForSpace();
  }
  if (ring_.push(row_)) {
    accepted_.fetch_add(1, std::memory_order_relaxed);
  } else {
    dropped_.fetch_add(1, std::memory_order_relaxed);
  }
}

void FileRecorder::fillRow(const Tick& tick) noexcept {
  TickRow row;
  row.index = tick.index;
  row.time = tick.time;
  row.device_time = device_->time;
  row.command_time = command_->time;
  row.object_time_end = objects_->time_end;
  row.device_count = device_->count();
  row.command_count = command_->count();
  row.stop_requested = device_->stop_requested ? 1 : 0;
  row.rearms = device_->rearms;
  row.surfaces_changed = surfaces_.hasValue() && surfaces_->happened ? 1 : 0;
  if (commanded_) {
    if (const std::size_t slot = commands_.next(commanded_->value()); slot != SettingsTaker::kNone) {
      row.commanded = slot + 1;
      row.commanded_value = (*commanded_)->slots[slot].value;
    }
  }
  row.output_status = command_->status;
  row.coverage_lost = contact_->coverage_lost;
  row.pop_through = contact_->pop_through;
  put(0, row);
  for (std::size_t f = 0; f < layout_.fingers; ++f) fillFinger(f, tick);
  for (std::size_t b = 0; b < layout_.bodies; ++b) fillBody(b, tick);
  for (std::size_t t = 0; t < layout_.tools.size(); ++t) fillTool(t, tick);
  for (std::size_t n = 0; n < layout_.frames; ++n) fillFrame(n, tick);
  if (layout_.orders) fillOrder(tick);
}

void FileRecorder::fillFinger(std::size_t finger, const Tick& tick) noexcept {
  const FingerInput& input = device_->fingers[finger];
  const FingerContact& contact = contact_->fingers[finger];
  FingerRow row;
  row.index = tick.index;
  row.time = tick.time;
  copy(input.p_WH, row.p_WH);
  copy(input.v_WH, row.v_WH);
  copy(contact.p_WP, row.p_WP);
  copy(contact.p_BP, row.p_BP);
  copy(contact.p_BC, row.p_BC);
  copy(contact.nhat_W, row.nhat_W);
  row.depth = contact.depth;
  row.normal_force = contact.normal_force;
  copy(contact.tangential_force_W, row.tangential_force_W);
  copy(contact.f_H_W, row.f_rendered_W);
  copy(command_->f_H_W[finger], row.f_command_W);
  row.phase = input.phase;
  row.valid = (input.valid ? 1 : 0) | (input.lost ? 2 : 0);
  row.mode = static_cast<std::int32_t>(contact.mode);
  row.body = contact.body;
  put(layout_.fingerOffset(finger), row);
}

void FileRecorder::fillTool(std::size_t slot, const Tick& tick) noexcept {
  const std::size_t finger = layout_.tools[slot];
  ToolRow row;
  row.index = tick.index;
  row.time = tick.time;
  copy(device_->fingers[finger].q_WT, row.q_WT);
  copy(device_->fingers[finger].w_WT, row.w_WT);
  copy(contact_->fingers[finger].t_H_W, row.t_rendered_W);
  copy(command_->t_H_W[finger], row.t_command_W);
  put(layout_.toolOffset(slot), row);
}

void FileRecorder::fillFrame(std::size_t frame, const Tick& tick) noexcept {
  FrameRow row;
  row.index = tick.index;
  row.time = tick.time;
  if (frames_->hasValue()) {
    const FrameNow& now = (*frames_)->frames[frame];
    copy(now.X_WF.p, row.p_WF);
    copy(now.X_WF.q, row.q_WF);
    row.zoom = now.zoom;
    row.doing = now.doing;
    row.uses = now.uses;
    row.refusals = now.refusals;
  }
  put(layout_.frameOffset(frame), row);
}

void FileRecorder::fillOrder(const Tick& tick) noexcept {
  const TakenOrders::Order order = orders_.next(ordered_->value());
  OrderRow row;
  row.index = tick.index;
  row.time = tick.time;
  row.tick = order.tick;
  row.goal = order.goal;
  row.body = order.body;
  put(layout_.orderOffset(), row);
}

void FileRecorder::fillBody(std::size_t slot, const Tick& tick) noexcept {
  const std::int32_t index = free_bodies_[slot];
  const In<ObjectState>& objects = shown_.connected() ? shown_ : objects_;
  const bool known = objects_.hasValue() && index < objects->count();
  const Pose X_WB = poseOf(world_->scene, known ? &objects.value() : nullptr, index, tick.time);
  BodyRow row;
  row.index = tick.index;
  row.time = tick.time;
  copy(X_WB.p, row.p_WB);
  copy(X_WB.q, row.q_WB);
  if (known) {
    const BodyMotion& motion = objects->bodies[static_cast<std::size_t>(index)];
    copy(motion.v_WB, row.v_WB);
    copy(motion.w_WB, row.w_WB);
  }
  put(layout_.bodyOffset(slot), row);
}

void FileRecorder::hurryWriter() noexcept {
  if (hurry_.load(std::memory_order_relaxed)) return;
  {
    const std::scoped_lock lock(mutex_);
    hurry_.store(true, std::memory_order_relaxed);
  }
  wake_.notify_one();
}

void FileRecorder::waitForSpace() noexcept {
  std::unique_lock lock(mutex_);
  space_.wait(lock, [this] { return !ring_.full(); });
}

// ---- writer thread

void FileRecorder::startWriter() {
  // the program's own threads handle signals; with SIGXFSZ blocked, a file-size limit becomes an error of write()
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  writer_ = std::thread([this] { write(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_setname_np(writer_.native_handle(), "presa-record");
}

void FileRecorder::write() {
  for (bool last = false; !last;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, settings_.look_every, [this] { return stop_ || hurry_.load(std::memory_order_relaxed); });
      hurry_.store(false, std::memory_order_relaxed);
      last = stop_;  // read before the last round, so that this round drains everything
    }
    if (settings_.before_round) settings_.before_round();
    drain();
  }
  closeFile();
}

void FileRecorder::drain() {
  std::size_t taken = 0;
  do {
    taken = drainBlock();
    drainSchedule();
    flushWhenDue();
  } while (taken > 0);
  writeFaults();
}

std::size_t FileRecorder::drainBlock() {
  const std::size_t rows = ring_.pop(block_.data(), block_.size() / layout_.words());
  if (!realtime_) {
    { const std::scoped_lock lock(mutex_); }  // ensures that step() is either before its test for space or waiting
    space_.notify_one();
  }
  if (rows > 0) onFile([&] { file_->append(block_.data(), rows); });
  return rows;
}

void FileRecorder::drainSchedule() {
  ScheduleLog* schedule = schedule_.load(std::memory_order_acquire);
  if (schedule == nullptr) return;
  if (!std::exchange(inputs_named_, true)) onFile([&] { file_->nameInputs(schedule->inputs); });
  for (int g = 0; g < kScheduledGroupCount; ++g) {
    auto& ring = *schedule->rings[static_cast<std::size_t>(g)];
    std::size_t rows = 0;
    do {
      for (rows = 0; rows < kBlockRows && ring.pop(schedule_block_[rows]);) ++rows;
      if (rows > 0) onFile([&] { file_->appendSchedule(static_cast<RateGroup>(g), schedule_block_.data(), rows); });
    } while (rows == kBlockRows);
  }
}

// Called after the rows have been written, so that the rows that led to a fault precede it.
void FileRecorder::writeFaults() {
  std::vector<std::string> faults;
  {
    const std::scoped_lock lock(mutex_);
    faults.swap(faults_);
  }
  for (const std::string& fault : faults) onFile([&] { file_->addFault(fault); });
  {
    const std::scoped_lock lock(mutex_);
    faults_unwritten_ -= faults.size();
  }
  if (!faults.empty()) space_.notify_all();
}

void FileRecorder::flushWhenDue() {
  const auto now = std::chrono::steady_clock::now();
  if (now - flushed_at_ < settings_.flush_every) return;
  flushed_at_ = now;
  onFile([this] {
    file_->writeDropped(lostInRings());
    file_->flush();
    if (settings_.after_flush) settings_.after_flush(file_->flushedTicks());
  });
}

void FileRecorder::closeFile() {
  onFile([this] {
    file_->writeDropped(lostInRings());
    file_->flush();
    if (complete_) file_->finish();
  });
  const h5::Library library;
  files_ = file_->files();
  file_.reset();
}

/// After a failure rows are discarded, so that no thread waits for a full disk.
template <class Work>
void FileRecorder::onFile(const Work& work) {
  if (failed_.load(std::memory_order_relaxed)) return;
  const h5::Library library;
  try {
    work();
  } catch (const std::exception&) {  // on any error the run goes on without recording
    file_->rollBack();
    kept_.store(file_->flushedTicks(), std::memory_order_relaxed);
    failed_.store(true, std::memory_order_release);
  }
}

// ---- program's thread

void FileRecorder::joinWriter() {
  if (!writer_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  writer_.join();
}

void FileRecorder::fault(double time, const std::string& what) {
  std::array<char, 32> at;
  std::snprintf(at.data(), at.size(), "%.3f s: ", time);
  std::unique_lock lock(mutex_);
  faults_.push_back(at.data() + what);
  ++faults_unwritten_;
  hurry_.store(true, std::memory_order_relaxed);
  wake_.notify_one();
  // in lockstep, wait until the fault is written; otherwise virtual time would run on meanwhile
  if (!realtime_) space_.wait(lock, [this] { return faults_unwritten_ == 0; });
}

void FileRecorder::finish() {
  {
    const std::scoped_lock lock(mutex_);
    complete_ = true;
  }
  joinWriter();
}

std::uint64_t FileRecorder::lostInRings() const noexcept {
  std::uint64_t lost = dropped_.load(std::memory_order_relaxed);
  if (const ScheduleLog* schedule = schedule_.load(std::memory_order_acquire)) {
    for (const auto& ring : schedule->rings) lost += ring->dropped();
  }
  return lost;
}

RecorderStatus FileRecorder::status() const noexcept {
  RecorderStatus status;
  status.failed = failed_.load(std::memory_order_acquire);
  status.rows = accepted_.load(std::memory_order_relaxed);
  status.dropped = lostInRings();
  if (status.failed) {
    const std::uint64_t kept = kept_.load(std::memory_order_relaxed);
    status.dropped += status.rows - kept;
    status.rows = kept;
  }
  return status;
}

}  // namespace presa::record
