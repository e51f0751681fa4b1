#include "framework/bus/remote_picture.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>

#include "framework/bus/rig_frames.h"
#include "framework/bus/scene_hash.h"
#include "framework/device/output_stage.h"

namespace presa::bus {
namespace {

// Maximum rate at which the estimated transport delay may grow [-]: somewhat above the drift between the clocks of two
// machines, and so low that occasional late packets do not shift the picture.
constexpr double kDrift = 2e-4;

constexpr double kSlack = 10;      // maximum distance of a sample's time from the newest [s],
constexpr double kFastest = 1000;  // plus this many simulated seconds per second since the last arrival

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

template <class... Values>
std::string print(const char* format, Values... values) {
  std::array<char, 160> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

const char* wordsOf(const Event& event) {
  if (event.kind == Event::Kind::kObjectFault) {
    if ((event.bits & kFaultBadEffect) != 0) return "a body effect broke its bound";
    return (event.bits & kFaultEngineFailed) != 0 ? "the dynamics engine failed" : "a body froze";
  }
  const char* fault = latchedFault(event.bits);
  return fault != nullptr ? fault : "forces are off";
}

}  // namespace

RemotePicture::RemotePicture(const World& world)
    : hash_(sceneHash(world)),
      rig_(rigFrames(world.rig)),
      fingers_(world.scene.devices.size()),
      frames_(world.rig.frames.size()) {
  for (const Body& body : world.scene.bodies) start_.push_back(body.X_WB);
  objects_.resize(start_.size());
}

template <class Sample>
std::pair<const Sample*, const Sample*> RemotePicture::Track<Sample>::around(double time) const noexcept {
  const Sample *before = nullptr, *after = nullptr;
  const std::uint64_t highest = watch.highest();
  for (std::uint64_t back = 0; back < kKept && back < highest && before == nullptr; ++back) {
    const Sample& sample = kept[(highest - back) % kKept];
    if (sample.stamp.sequence != highest - back) continue;  // lost
    (sample.stamp.time <= time ? before : after) = &sample;
  }
  return {before, after};
}

void RemotePicture::onRun(const RunInfo& run, std::int64_t received_ns) {
  if (run.run == run_.run) return;
  const bool busy = state_ == State::kLive && seconds(received_ns - last_arrival_ns_) < kSilence;
  if (busy)
    waiting_ = run;
  else
    beginRun(run);
}

// The last picture stays visible until the new run delivers a state.
void RemotePicture::beginRun(const RunInfo& run) noexcept {
  if (state_ == State::kFrozen) ++counted_.resumed;
  run_ = run;
  waiting_ = {};
  wrong_scene_ = run.scene_hash != hash_;
  objects_.assign(start_.size(), {});
  fingers_.assign(fingers_.size(), {});
  frames_.assign(run.frames == rig_ ? rig_.size() : 0, {});
  heartbeats_ = {};
  clock_known_ = false;
  time_ = newest_ = 0;
  last_event_.clear();
  state_ = State::kWaiting;
}

bool RemotePicture::follows(const Stamp& stamp, std::int64_t received_ns) noexcept {
  if (stamp.run != run_.run && stamp.run != 0 && stamp.run == waiting_.run) {
    const bool free = state_ != State::kLive || seconds(received_ns - last_arrival_ns_) >= kSilence;
    if (free) beginRun(RunInfo(waiting_));
  }
  if (stamp.run != run_.run || stamp.run == 0) return false;
  if (wrong_scene_) {
    ++counted_.other_scene;
    last_arrival_ns_ = received_ns;
    return false;
  }
  return true;
}

// Limits the rate of simulated time. Otherwise a single forged time would make all genuine ones look old.
bool RemotePicture::isTimely(const Stamp& stamp, std::int64_t received_ns) const noexcept {
  if (!std::isfinite(stamp.time)) return false;
  if (!clock_known_) return true;
  const double elapsed = std::max(0.0, seconds(received_ns - last_arrival_ns_));
  return std::abs(stamp.time - newest_) <= kSlack + kFastest * elapsed;
}

template <class Sample>
bool RemotePicture::keep(Track<Sample>& track, const Sample& sample, std::int64_t received_ns) noexcept {
  if (!isTimely(sample.stamp, received_ns)) {
    ++counted_.strays;
    return false;
  }
  const std::uint64_t before = track.watch.lost();
  const SequenceWatch::Arrival arrival = track.watch.see(sample.stamp.sequence);
  counted_.lost += track.watch.lost() - before;  // modulo 2^64: a late arrival reduces the loss by one
  if (arrival == SequenceWatch::Arrival::kStray) {
    ++counted_.strays;
    return false;
  }
  if (arrival == SequenceWatch::Arrival::kDouble) {
    ++counted_.doubled;
    return true;
  }
  if (arrival == SequenceWatch::Arrival::kLate) ++counted_.late;
  ++counted_.received;
  track.kept[sample.stamp.sequence % kKept] = sample;
  latency_.add(received_ns - sample.stamp.sent_ns);
  noteArrival(sample.stamp, received_ns);
  return true;
}

void RemotePicture::noteArrival(const Stamp& stamp, std::int64_t received_ns) noexcept {
  if (state_ != State::kLive && state_ != State::kEnded) {
    if (state_ == State::kFrozen) ++counted_.resumed;
    state_ = State::kLive;
    clock_known_ = false;  // time has gone on during the silence, so the clock offset is estimated anew
  }
  last_arrival_ns_ = received_ns;
  if (stamp.time < newest_) return;
  newest_ = stamp.time;
  const double offset = seconds(received_ns) - stamp.time;
  if (!clock_known_ || offset < offset_)
    offset_ = offset;
  else
    offset_ += std::min(offset - offset_, kDrift * (stamp.time - offset_time_));
  offset_time_ = stamp.time;
  clock_known_ = true;
}

void RemotePicture::onObject(const ObjectSample& sample, std::int64_t received_ns) {
  if (!follows(sample.stamp, received_ns)) return;
  const auto body = static_cast<std::size_t>(sample.body);
  if (body < objects_.size()) keep(objects_[body], sample, received_ns);
}

void RemotePicture::onFinger(const FingerSample& sample, std::int64_t received_ns) {
  if (!follows(sample.stamp, received_ns)) return;
  const auto finger = static_cast<std::size_t>(sample.finger);
  if (finger < fingers_.size()) keep(fingers_[finger], sample, received_ns);
}

void RemotePicture::onFrame(const FrameSample& sample, std::int64_t received_ns) {
  if (!follows(sample.stamp, received_ns)) return;
  const auto frame = static_cast<std::size_t>(sample.frame);
  if (frame < frames_.size()) keep(frames_[frame], sample, received_ns);
}

void RemotePicture::onHeartbeat(const Heartbeat& heartbeat, std::int64_t received_ns) {
  if (!follows(heartbeat.stamp, received_ns)) {
    if (wrong_scene_ && heartbeat.last && heartbeat.stamp.run == run_.run) state_ = State::kEnded;
    return;
  }
  if (!keep(heartbeats_, heartbeat, received_ns)) return;
  if (heartbeat.stamp.sequence != heartbeats_.watch.highest()) return;
  counted_.refused = heartbeat.refused;
  if (heartbeat.last) state_ = State::kEnded;
}

void RemotePicture::onEvent(const Event& event, std::int64_t received_ns) {
  if (!follows(event.stamp, received_ns)) return;
  last_event_ = print("%.3f s: %s", event.stamp.time, wordsOf(event));
}

void RemotePicture::advance(std::int64_t now_ns) noexcept {
  now_ns_ = now_ns;
  if (state_ == State::kLive && seconds(now_ns - last_arrival_ns_) > kSilence) state_ = State::kFrozen;
  if (!clock_known_) return;
  if (state_ == State::kEnded) {
    time_ = newest_;
    return;
  }
  const double wanted = seconds(now_ns) - offset_ - run_.period;
  time_ = std::max(time_, std::min(wanted, newest_));
}

Pose RemotePicture::poseOf(std::size_t body) const noexcept {
  const auto [before, after] = objects_[body].around(time_);
  if (before == nullptr) return after != nullptr ? after->X_WB : start_[body];
  if (after == nullptr) return before->X_WB;
  const double share = (time_ - before->stamp.time) / (after->stamp.time - before->stamp.time);
  return share > 0 ? interpolate(before->X_WB, after->X_WB, std::min(share, 1.0)) : before->X_WB;
}

void RemotePicture::fill(ObjectState& objects, DeviceState& device, ContactExchange& contact,
                         ForceCommand& command) const noexcept {
  objects.time_begin = objects.time_end = device.time = contact.time = command.time = time_;
  objects.bodies.resize(objects_.size());
  for (std::size_t b = 0; b < objects_.size(); ++b) {
    BodyMotion& motion = objects.bodies[b];
    motion.X_WB_begin = motion.X_WB_end = poseOf(b);
    if (const ObjectSample* newest = objects_[b].around(time_).first; newest != nullptr) {
      motion.v_WB = newest->v_WB;
      motion.w_WB = newest->w_WB;
      motion.asleep = newest->asleep;
    }
  }
  device.fingers.resize(fingers_.size());
  contact.fingers.resize(fingers_.size());
  command.f_H_W.resize(fingers_.size());
  command.t_H_W.resize(fingers_.size());
  for (std::size_t f = 0; f < device.fingers.size(); ++f) {
    const auto [before, after] = fingers_[f].around(time_);
    const FingerSample* sample = before != nullptr ? before : after;
    device.fingers[f] = {};
    contact.fingers[f] = {};
    command.f_H_W[f].setZero();
    command.t_H_W[f].setZero();
    if (sample == nullptr) continue;
    device.fingers[f].valid = sample->valid;
    device.fingers[f].p_WH = sample->p_WH;
    device.fingers[f].oriented = sample->oriented;
    device.fingers[f].q_WT = sample->q_WT;
    contact.fingers[f] = sample->contact;
    command.f_H_W[f] = sample->f_H_W;
    command.t_H_W[f] = sample->t_H_W;
    if (before == nullptr || after == nullptr) continue;
    const double share = (time_ - before->stamp.time) / (after->stamp.time - before->stamp.time);
    if (!(share > 0)) continue;
    const Vec3 p_WH = before->p_WH + share * (after->p_WH - before->p_WH);
    device.fingers[f].p_WH = contact.fingers[f].p_WH = p_WH;
    device.fingers[f].q_WT = before->q_WT.slerp(share, after->q_WT);
  }
  const Heartbeat* heartbeat = heartbeats_.around(time_).first;
  command.status = heartbeat != nullptr ? heartbeat->output_status : 0;
  objects.faults = heartbeat != nullptr ? heartbeat->object_faults : 0;
}

void RemotePicture::fill(FrameState& frames) const {
  frames.time = time_;
  frames.frames.clear();
  for (const Track<FrameSample>& track : frames_) {
    const auto [before, after] = track.around(time_);
    if (before == nullptr && after == nullptr) return frames.frames.clear();
    FrameNow& now = frames.frames.emplace_back(before != nullptr ? before->now : after->now);
    if (before == nullptr || after == nullptr) continue;
    const double share = (time_ - before->stamp.time) / (after->stamp.time - before->stamp.time);
    if (share > 0) now.X_WF = interpolate(before->now.X_WF, after->now.X_WF, std::min(share, 1.0));
  }
}

RemotePicture::Health RemotePicture::health() const noexcept {
  Health health = counted_;
  health.silent = last_arrival_ns_ == 0 ? 0 : seconds(now_ns_ - last_arrival_ns_);
  health.behind = newest_ - time_;
  return health;
}

std::string RemotePicture::line() const {
  const Health now = health();
  if (wrong_scene_) {
    return print("another scene runs there: hash %016" PRIx64 ", here %016" PRIx64, run_.scene_hash, hash_);
  }
  if (state_ == State::kWaiting) return "waiting for a run on the bus";
  std::string text;
  if (state_ == State::kFrozen) text = print("FROZEN: nothing on the bus for %.1f s", now.silent);
  if (state_ == State::kLive) text = print("remote, %.1f ms behind", 1e3 * now.behind);
  if (state_ == State::kEnded) text = "the run has ended";
  const std::uint64_t all = now.received + now.lost;
  text += print(", lost %" PRIu64 " of %" PRIu64, now.lost, all);
  if (now.refused > 0) text += print(", %" PRIu64 " never sent", now.refused);
  if (now.resumed > 0) text += print(", came back %" PRIu64 " times", now.resumed);
  if (!last_event_.empty()) text += "; " + last_event_;
  return text;
}

}  // namespace presa::bus
