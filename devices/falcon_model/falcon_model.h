#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "devices/falcon_model/force_watch.h"
#include "devices/falcon_model/grip.h"
#include "devices/falcon_model/processor.h"
#include "devices/falcon_model/reply_fate.h"
#include "devices/falcon_model/serial_line.h"
#include "framework/core/math/random.h"

namespace presa::falcon_model {

struct ModelSettings {
  std::uint64_t seed = 1;
  bool has_firmware = false;  ///< firmware was loaded before, and the power stayed on
  bool homed = false;         ///< and the grip was homed
  LoaderSettings loader;
  GripSettings grip;
};

/// A model of a Novint Falcon at its USB socket, in virtual time: settings of the converter, boot loader and firmware,
/// one reply per request, encoders, references, buttons, lights, motors, and a grip in a hand. The caller passes the
/// time [s], never decreasing; equal calls give equal bytes. Received forces are checked (ForceWatch).
/// Thread: one at a time; it takes no lock.
class FalconModel {
 public:
  explicit FalconModel(ModelSettings settings = {});

  // ---- USB socket, used by a host
  /// Vendor request 0x40; false: refused.
  bool vendorRequest(std::uint8_t request, std::uint16_t value, double now);
  bool hostWrites(std::span<const std::uint8_t> bytes, double now);
  /// The next IN packet for a host that has been waiting since `asked`.
  std::optional<SerialLine::Packet> toHost(double now, double asked);
  /// Reports that the host's program has read this byte; its information counts as known from now on.
  void hostHasRead(const WireByte& byte, double now);
  bool plugged() const { return plugged_; }
  /// Re-arm after a lost reference: after ten more replies the host may apply forces again.
  void forgive();
  /// Number of power-ups; a connection opened before the latest one is lost.
  int powerUps() const { return power_ups_; }
  /// Takes the device for one program; false when another has it.
  bool claim();
  void release() { claimed_ = false; }

  // ---- environment
  Grip& grip() { return grip_; }
  void advance(double now);
  void buttons(unsigned bits) { buttons_ = bits; }

  // ---- faults
  void unplug(double now);
  void plug(double now);
  void limits(const WatchLimits& limits) { watch_.limits(limits); }
  void onReply(std::function<void(ReplyFate&)> fault) { reply_fault_ = std::move(fault); }
  /// Requests are executed but not answered.
  void mute(double from, double until) { mute_from_ = from, mute_until_ = until; }
  /// Requests do not arrive; the motors hold their last force.
  void deafen(double from, double until) { deaf_from_ = from, deaf_until_ = until; }
  /// Refuses `count` vendor requests, starting with the n-th from now on (1: the next).
  void refuseRequests(int nth, int count = 1) { refuse_after_ = nth - 1, refuse_count_ = count; }

  // ---- observation
  Processor::State state() const { return processor_.state(); }
  const Processor& processor() const { return processor_; }
  const SerialLine& line() const { return line_; }
  const Received& received() const { return received_; }
  void onRequest(std::function<void(const Received&)> listener) { listener_ = std::move(listener); }
  int requests() const { return requests_; }
  int replies() const { return replies_; }
  const ForceWatch& watch() const { return watch_; }
  const std::vector<std::string>& violations() const { return watch_.violations(); }
  /// Time since the last request [s]. holdsForce(): the motors hold a force meanwhile.
  double quietFor(double now) const { return now - received_.time; }
  bool holdsForce() const;

 private:
  void obey(const Request& request, const WireByte& last);
  void answer(double time);
  Mat3 ratesTold(const Status& status) const;
  void send(std::span<const std::uint8_t> bytes, std::uint32_t tag, double time);

  ModelSettings settings_;
  RandomStream random_;
  SerialLine line_;
  Processor processor_;
  Grip grip_;
  ForceWatch watch_;
  bool plugged_ = true, claimed_ = false;
  int power_ups_ = 0;

  Knowledge knowledge_;                        // current knowledge of the host
  std::map<std::uint32_t, Knowledge> writes_;  // its knowledge at the time of each write still on the wire
  std::uint32_t write_ = 0;
  struct Sent {
    Mat3 rates;
    bool all_homed;
  };
  std::map<std::uint32_t, Sent> sent_;  // replies not yet read by the host, by tag
  std::uint32_t reply_ = 0;

  Received received_;
  std::function<void(const Received&)> listener_;
  std::function<void(ReplyFate&)> reply_fault_;
  std::optional<std::pair<ReplyFate, std::uint32_t>> waits_for_next_;
  unsigned buttons_ = 0;
  int requests_ = 0, replies_ = 0;
  double mute_from_ = 0, mute_until_ = 0, deaf_from_ = 0, deaf_until_ = 0;
  int refuse_after_ = 0, refuse_count_ = 0;
};

}  // namespace presa::falcon_model
