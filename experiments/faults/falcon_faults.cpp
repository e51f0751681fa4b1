#include <algorithm>
#include <limits>
#include <span>

#include "experiments/faults/falcon_finger.h"

namespace presa::faults {
namespace {

using falcon::FalconLink;
using falcon::LinkFault;
using falcon::LinkState;
using falcon_model::FalconModel;
using falcon_model::ReplyFate;
using falcon_model::UploadFault;

constexpr double kAfter = 0.7;  // [s] observed after the fault
constexpr unsigned kButtons = 2 | 8;

/// A moment while the fingers press, right after a tick.
double anyMoment(RandomStream& random) { return 1e-3 * static_cast<double>(950 + random.below(1650)); }

/// The hold scenario with two Falcons; the thumb's Falcon fails.
struct FalconHold {
  explicit FalconHold(RandomStream& random) {
    for (const std::size_t f : {0UL, 1UL}) {
      auto finger = std::make_unique<FalconFinger>(hold, f == 0 ? -1 : 1, random.bits(), transports[f]);
      fingers[f] = finger.get();
      devices.push_back(std::move(finger));
    }
  }
  FalconFinger& thumb() { return *fingers[0]; }

  /// Runs the scenario and calls `at(time)` after every tick. Violations seen by the models go to the outcome. The
  /// forces of `fingers_that_answer` must react to the fault in time; all forces must be zero in time.
  Outcome run(double end, double begin, double until, unsigned fingers_that_answer,
              const std::function<void(double)>& at) {
    Judge judge(begin, until, fingers_that_answer), all(begin, until);
    hold.end = end;
    runHold(hold, {std::move(devices), transports, clock}, [&](double time, const Traffic& traffic) {
      judge.see(time, traffic);
      all.see(time, traffic);
      at(time);
      for (const std::size_t f : {0UL, 1UL}) violations[f] = fingers[f]->model().violations();
    });
    Outcome outcome = judge.outcome();
    outcome.zero = all.outcome().zero;
    for (const std::size_t f : {0UL, 1UL}) {
      outcome.broken.insert(outcome.broken.end(), violations[f].begin(), violations[f].end());
    }
    return outcome;
  }

  Hold hold;
  std::array<Transport, 2> transports;
  std::array<FalconFinger*, 2> fingers{};
  std::array<std::vector<std::string>, 2> violations;
  DeviceList devices;
  double clock = 0;
};

/// True once, when the moment has come.
struct Once {
  double moment;
  bool done = false;
  bool comes(double time) { return !done && time >= moment - 1e-9 && (done = true); }
};

/// Row 1: unplugged and plugged in again. Nothing returns without a re-arm, and a re-arm finds neither firmware nor
/// references.
Outcome unplugged(RandomStream& random) {
  FalconHold bench(random);
  const double begin = anyMoment(random), replugged = begin + random.uniform(0.02, 0.4);
  Once pulled{begin}, back{replugged};
  return bench.run(begin + kAfter, begin, kForever, 3, [&](double time) {
    if (pulled.comes(time)) bench.thumb().model().unplug(FalconFinger::timeOf(time));
    if (back.comes(time)) bench.thumb().model().plug(FalconFinger::timeOf(time));
  });
}

/// Damages replies (truncated, extended, flipped bits) until no part of the byte stream passes as a reply. Replies have
/// no checksum, so bytes of the right format are indistinguishable from a reply.
class Damage {
 public:
  explicit Damage(RandomStream& random) : random_(random) {}

  void operator()(ReplyFate& reply) {
    const std::vector<std::uint8_t> good = reply.bytes;
    do {
      reply.bytes = good;
      change(reply);
    } while (looksRight(reply.bytes));
  }
  /// To be called for every reply, damaged or not.
  void sent(const ReplyFate& reply) {
    before_.insert(before_.end(), reply.bytes.begin(), reply.bytes.end());
    constexpr std::size_t kMaxKept = falcon_model::kFrame - 1;
    if (before_.size() > kMaxKept) before_.erase(before_.begin(), before_.end() - kMaxKept);
  }

 private:
  void change(ReplyFate& reply) {
    switch (random_.below(4)) {
      case 0:
        return shorten(reply, random_);
      case 1:
        return reply.bytes.resize(random_.below(reply.bytes.size()));
      case 2: {
        const auto where = static_cast<std::ptrdiff_t>(random_.below(reply.bytes.size()));
        reply.bytes.insert(reply.bytes.begin() + where, static_cast<std::uint8_t>(random_.below(256)));
        return;
      }
      default:
        return flipBits(reply, random_, 1 + static_cast<int>(random_.below(4)));
    }
  }
  bool looksRight(const std::vector<std::uint8_t>& bytes) const {
    std::vector<std::uint8_t> stream = before_;
    stream.insert(stream.end(), bytes.begin(), bytes.end());
    for (std::size_t i = 0; i + falcon_model::kFrame <= stream.size(); ++i) {
      if (falcon_model::statusOf(std::span(stream).subspan(i, falcon_model::kFrame))) return true;
    }
    return false;
  }

  RandomStream& random_;
  std::vector<std::uint8_t> before_;
};

/// Row 3. The driver must never report a flag or button that the device did not have, and recovers within two good
/// replies.
Outcome mutatedReplies(RandomStream& random) {
  FalconHold bench(random);
  const double begin = anyMoment(random), end = begin + 0.3;
  const std::uint64_t share = 1 + random.below(8);
  FalconModel& model = bench.thumb().model();
  const FalconLink& link = bench.thumb().link();
  model.buttons(kButtons);
  RandomStream bits(random.bits(), "replies");
  Damage damage(bits);
  bool watching = false, lied = false, slow = false;
  std::uint64_t good_after = 0;
  bench.thumb().at_step = [&] {
    lied = lied || (watching && (link.status().homed != 7 || link.sample().buttons != kButtons));
    if (good_after > 0 && link.status().replies == good_after + 2) slow = slow || !link.sample().valid;
  };
  Once starts{begin}, stops{end};
  Outcome outcome = bench.run(end + kAfter, begin, kForever, 1, [&](double time) {
    if (starts.comes(time)) {
      watching = true;
      model.onReply([&](ReplyFate& reply) {
        if (bits.below(share) == 0) damage(reply);
        damage.sent(reply);
        if (bits.below(10) == 0) split(reply, bits);
        reply.waits = bits.below(20) == 0;
      });
    }
    if (stops.comes(time)) {
      model.onReply(nullptr);
      good_after = link.status().replies;
    }
  });
  if (lied) outcome.broken.emplace_back("reported a flag or button that the device never had");
  if (slow) outcome.broken.emplace_back("no recovery after two good replies");
  outcome.detection = outcome.zero = 0;  // a reaction is allowed, not required
  return outcome;
}

/// Row 18. The next reply reports the loss; the request after it is already lower.
Outcome referenceLost(RandomStream& random) {
  FalconHold bench(random);
  const double begin = anyMoment(random);
  const std::size_t encoder = random.below(3);
  Once drops{begin};
  return bench.run(begin + kAfter, begin, kForever, 1, [&](double time) {
    if (drops.comes(time)) bench.thumb().model().grip().loseReference(encoder);
  });
}

/// Row 17: the link alone, without a scene: no firmware on the device, and a firmware file that is missing, wrong,
/// truncated, or echoed wrongly.
Outcome firmwareFails(RandomStream& random) {
  enum { kMissing, kOther, kCut, kEcho };
  const auto kind = random.below(4);
  falcon_model::ModelSettings settings;
  settings.seed = random.bits();
  std::vector<std::uint8_t> file = settings.loader.firmware = madeUpFirmware();
  settings.loader.deaf_greetings = static_cast<int>(random.below(4));
  settings.loader.zero_before = random.below(2) == 0;
  const auto errors = static_cast<int>(random.below(13));  // more than ten are too many
  if (kind == kMissing) file.clear();
  if (kind == kOther) file[4 + random.below(file.size() - 4)] ^= static_cast<std::uint8_t>(1 + random.below(255));
  if (kind == kCut) file.resize(4 + random.below(file.size() - 4));
  for (int attempt = 0; kind == kEcho && attempt < errors; ++attempt) {
    settings.loader.faults.push_back(
        {attempt, random.below(file.size()), static_cast<UploadFault::Kind>(random.below(3))});
  }
  FalconModel model(settings);
  const auto usb = falcon_model::ModelTransport::open(model);
  FalconLink link(*usb, file, {});
  link.open(0);
  bool pushed = false;
  model.onRequest([&](const falcon_model::Received& request) {
    pushed = pushed || request.counts != std::array{0, 0, 0};
  });
  double now = 0;
  for (int i = 1; i < 800'000 && link.status().state == LinkState::kStarting; ++i) {
    now = 0.25e-3 * i;
    link.step(now, {{0, 0, 3}, now});
  }
  for (int i = 0; i < 2000; ++i)
    link.step(now += 0.25e-3, {{0, 0, 3}, now});  // asks for a force, but the device is not homed
  Outcome outcome;
  const auto require = [&](bool holds, const char* what) {
    if (!holds) outcome.broken.emplace_back(what);
  };
  const auto status = link.status();
  const bool loads = kind == kEcho && errors < falcon::FalconLoader::kMaxAttempts;
  const LinkFault fault = status.fault;
  require(status.state == (loads ? LinkState::kHoming : LinkState::kDead),
          "brought up, or given up, against the facts");
  require(kind != kMissing || fault == LinkFault::kNoFirmware, "the missing firmware file was not reported");
  require((kind != kOther && kind != kCut) || fault == LinkFault::kFirmwareSilent,
          "the wrong firmware file was not reported");
  require(kind != kEcho || loads || fault == LinkFault::kEchoMismatch || fault == LinkFault::kEchoMissing,
          "the wrong echo was not reported");
  require(loads || *remedy(fault) != '\0', "no remedy was reported");
  require(model.processor().uploads() <= 10, "more than ten attempts");
  require(!pushed, "force before the device was homed");
  outcome.broken.insert(outcome.broken.end(), model.violations().begin(), model.violations().end());
  return outcome;
}

/// Row 19: during the grasp another program tries to open the device.
Outcome secondProgram(RandomStream& random) {
  FalconHold bench(random);
  const double begin = anyMoment(random);
  Once asks{begin};
  bool refused = true;
  Outcome outcome = bench.run(begin + 0.2, begin, begin + 0.01, 3, [&](double time) {
    if (asks.comes(time)) refused = falcon_model::ModelTransport::open(bench.thumb().model()) == nullptr;
  });
  if (!refused) outcome.broken.emplace_back("two programs opened the device");
  if (outcome.detection >= 0) outcome.broken.emplace_back("the first program's force was disturbed");
  outcome.detection = outcome.zero = 0;
  return outcome;
}

}  // namespace

std::vector<Fault> falconFaults() {
  return {
      {1,
       "a Falcon unplugged in the grasp, and back",
       "the other device goes to zero; nothing comes back",
       {0.003, 0.020, false},
       unplugged},
      {3,
       "replies of a Falcon cut, grown, split or with bits flipped",
       "no false flag or button; good again within two good replies",
       {},
       mutatedReplies},
      {17,
       "firmware of a Falcon missing, another, cut off, echoed wrongly",
       "a clear reason, ten attempts at most, no force before homing",
       {},
       firmwareFails},
      {18,
       "an encoder of a Falcon loses its reference",
       "down from the same cycle on, latched",
       {0.003, 0.010, false},
       referenceLost},
      {19, "a second program asks for a Falcon in use", "refused; the first feels nothing of it", {}, secondProgram},
  };
}

}  // namespace presa::faults
