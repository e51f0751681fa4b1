#include "devices/falcon_model/falcon_model.h"

#include <algorithm>

#include "devices/falcon_model/legs.h"

namespace presa::falcon_model {
namespace {

constexpr double kThinks = 20e-6;  // from the last byte of a request to the first of its reply [s]

}  // namespace

FalconModel::FalconModel(ModelSettings settings)
    : settings_(std::move(settings)),
      random_(settings_.seed, "falcon model"),
      processor_(settings_.loader),
      grip_(settings_.grip) {
  plug(0);
  if (settings_.homed) grip_.reference();
}

void FalconModel::plug(double now) {
  if (power_ups_ > 0) advance(now);
  plugged_ = true;
  line_ = {};
  processor_.switchOn(settings_.has_firmware && power_ups_ == 0);  // firmware is lost with the power
  ++power_ups_;
  grip_.switchOn();
  received_ = {};
  watch_.forget();
  knowledge_ = {};
  writes_.clear();
  sent_.clear();
  waits_for_next_.reset();
  claimed_ = false;
}

void FalconModel::unplug(double now) {
  advance(now);
  plugged_ = claimed_ = false;
  grip_.switchOn();  // motors off, references lost
}

bool FalconModel::claim() {
  if (!plugged_ || claimed_) return false;
  claimed_ = true;
  knowledge_ = {};  // a new program knows nothing yet
  return true;
}

void FalconModel::forgive() {
  knowledge_.lost_homed = false;
  knowledge_.homed_replies = 0;
}

bool FalconModel::vendorRequest(std::uint8_t request, std::uint16_t value, double now) {
  if (!plugged_) return false;
  advance(now);
  if (refuse_count_ > 0 && refuse_after_-- <= 0) {
    --refuse_count_;
    return false;
  }
  const bool dtr = line_.dtr();
  if (!line_.request(request, value, now)) return false;
  processor_.linesChanged(line_, dtr);
  return true;
}

bool FalconModel::hostWrites(std::span<const std::uint8_t> bytes, double now) {
  if (!plugged_) return false;
  advance(now);
  if (!line_.hostWrites(bytes, write_ + 1, now)) return false;
  writes_.emplace(++write_, knowledge_);
  return true;
}

std::optional<SerialLine::Packet> FalconModel::toHost(double now, double asked) {
  if (!plugged_) return std::nullopt;
  advance(now);
  return line_.toHost(now, asked);
}

void FalconModel::hostHasRead(const WireByte& byte, double now) {
  const auto found = sent_.find(byte.tag);
  if (byte.tag == 0 || found == sent_.end()) return;
  const Sent& sent = found->second;
  std::shift_right(knowledge_.rates.begin(), knowledge_.rates.end(), 1);
  knowledge_.rates[0] = sent.rates;
  knowledge_.poses = std::min(knowledge_.poses + 1, Knowledge::kPoses);
  if (sent.all_homed) {
    ++knowledge_.homed_replies;
  } else {
    const bool lost = knowledge_.homed_replies >= ForceWatch::kHomedReplies;  // only a complete homing can be lost
    knowledge_.homed_replies = 0;
    if (lost && !knowledge_.lost_homed) knowledge_.lost_at = now;
    knowledge_.lost_homed = knowledge_.lost_homed || lost;
  }
  sent_.erase(sent_.begin(), std::next(found));  // earlier replies will not arrive any more
}

void FalconModel::advance(double now) {
  while (const std::optional<WireByte> byte = line_.atProcessor(now)) {
    grip_.advance(byte->time);
    const bool deaf = byte->time >= deaf_from_ && byte->time < deaf_until_;
    if (deaf || !plugged_) continue;
    if (const std::optional<Request> request = processor_.hear(*byte, line_)) obey(*request, *byte);
  }
  grip_.advance(now);
}

void FalconModel::obey(const Request& request, const WireByte& last) {
  ++requests_;
  const auto known = writes_.find(last.tag);
  Knowledge knowledge = known == writes_.end() ? Knowledge{} : known->second;
  received_.time = last.time;
  received_.counts = request.counts;
  received_.force_D = forceOf(request.counts, grip_.rates());
  received_.meant_D = knowledge.poses > 0 ? forceOf(request.counts, knowledge.rates[0]) : received_.force_D;
  received_.homing = request.homing;
  received_.green = request.green;
  received_.blue = request.blue;
  received_.red = request.red;
  knowledge.rates[knowledge.poses++] = grip_.rates();
  watch_.see(received_, knowledge);
  writes_.erase(writes_.begin(), known);
  grip_.drive(request.counts);
  grip_.seekReferences(request.homing);
  if (listener_) listener_(received_);
  if (last.time < mute_from_ || last.time >= mute_until_) answer(last.time + kThinks);
}

void FalconModel::answer(double time) {
  ++replies_;
  Status status;
  status.counters = grip_.counters();
  status.homed = grip_.homed();
  status.buttons = buttons_;
  const auto meaningless = static_cast<std::uint8_t>(0x41 + random_.below(16));
  const Frame frame = frameOf(status, meaningless);
  ReplyFate fate;
  fate.bytes.assign(frame.begin(), frame.end());
  if (reply_fault_) reply_fault_(fate);
  std::uint32_t tag = 0;
  if (const std::optional<Status> told = statusOf(fate.bytes)) {
    sent_.emplace(tag = ++reply_, Sent{ratesTold(*told), told->homed == 7});
  }
  if (waits_for_next_) {
    send(waits_for_next_->first.bytes, waits_for_next_->second, time);
    waits_for_next_.reset();
  }
  if (fate.waits) {
    waits_for_next_ = {fate, tag};
    return;
  }
  const std::span<const std::uint8_t> bytes(fate.bytes);
  const std::size_t first = std::min(fate.first, bytes.size());
  send(bytes.first(first), first == bytes.size() ? tag : 0, time);
  send(bytes.subspan(first), tag, time + fate.pause);
}

/// The Jacobian at the pose that a host computes from these counters.
Mat3 FalconModel::ratesTold(const Status& status) const {
  const Vec3 counts(status.counters[0], status.counters[1], status.counters[2]);
  const Vec3 thighs = Vec3::Constant(kThighAtZero) + kThighPerCount * counts;
  const std::optional<Vec3> p_D = gripAt(thighs, grip_.position());
  return p_D ? thighRates(*p_D, thighs) : grip_.rates();
}

/// Attaches the tag to the last byte, which completes the reply.
void FalconModel::send(std::span<const std::uint8_t> bytes, std::uint32_t tag, double time) {
  if (bytes.empty()) return;
  line_.processorWrites(bytes.first(bytes.size() - 1), Processor::kOperationBaud, 0, time);
  line_.processorWrites(bytes.last(1), Processor::kOperationBaud, tag, time);
}

bool FalconModel::holdsForce() const { return plugged_ && received_.counts != std::array<int, 3>{}; }

}  // namespace presa::falcon_model
