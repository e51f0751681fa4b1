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
  bool has_firmware = false;  ///< it was loaded before, and power stayed on
  bool homed = false;         ///< and the grip was pulled out and pushed in
  LoaderSettings loader;
  GripSettings grip;
};

/// A Novint Falcon behind its USB socket, as far as is known of it, in virtual time: settings of the converter, boot loader and firmware,
/// one reply for each request, encoders, references, buttons, lights, motors, and a grip in a hand. Whoever holds it says what the time
/// is [s], never backwards; same calls, same bytes. It judges the forces that arrive (ForceWatch).
/// Thread: one at a time; it takes no lock.
class FalconModel {
 public:
  explicit FalconModel(ModelSettings settings = {});

  // ---- the socket: what a host may do
  /// Vendor request 0x40; false: refused.
  bool vendorRequest(std::uint8_t request, std::uint16_t value, double now);
  bool hostWrites(std::span<const std::uint8_t> bytes, double now);
  /// The next IN packet for a host that has been asking since `asked`.
  std::optional<SerialLine::Packet> toHost(double now, double asked);
  /// The host's program has taken this byte out of its packet: from now on it can know.
  void hostHasRead(const WireByte& byte, double now);
  bool plugged() const { return plugged_; }
  /// Somebody has looked and armed the host again: after ten more replies it may push.
  void forgive();
  /// Counts each time that power came on: who opened an earlier one has lost it.
  int powerUps() const { return power_ups_; }
  /// One program at a time.
  bool claim();
  void release() { claimed_ = false; }

  // ---- the world around it
  Grip& grip() { return grip_; }
  void advance(double now);
  void buttons(unsigned bits) { buttons_ = bits; }

  // ---- what may go wrong
  void unplug(double now);
  void plug(double now);
  void limits(const WatchLimits& limits) { watch_.limits(limits); }
  void onReply(std::function<void(ReplyFate&)> fault) { reply_fault_ = std::move(fault); }
  /// Requests are obeyed, nothing is answered.
  void mute(double from, double until) { mute_from_ = from, mute_until_ = until; }
  /// Requests do not arrive either: motors hold what they had.
  void deafen(double from, double until) { deaf_from_ = from, deaf_until_ = until; }
  /// The n-th vendor request from now on (1: the next) is refused, and so are those after it up to `count`.
  void refuseRequests(int nth, int count = 1) { refuse_after_ = nth - 1, refuse_count_ = count; }

  // ---- what there is to see
  Processor::State state() const { return processor_.state(); }
  const Processor& processor() const { return processor_; }
  const SerialLine& line() const { return line_; }
  const Received& received() const { return received_; }
  void onRequest(std::function<void(const Received&)> listener) { listener_ = std::move(listener); }
  int requests() const { return requests_; }
  int replies() const { return replies_; }
  const ForceWatch& watch() const { return watch_; }
  const std::vector<std::string>& violations() const { return watch_.violations(); }
  /// The device's own view of a process that is gone: no request for this long [s], and whether motors hold a force meanwhile.
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

  Knowledge knowledge_;                        // of the host now
  std::map<std::uint32_t, Knowledge> writes_;  // and when it wrote what is still on the wire
  std::uint32_t write_ = 0;
  struct Sent {
    Mat3 rates;
    bool all_homed;
  };
  std::map<std::uint32_t, Sent> sent_;  // replies that the host has not read yet, by their tag
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
