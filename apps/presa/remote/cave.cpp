#include "apps/presa/remote/cave.h"

#include <bit>
#include <cstdio>

#include "framework/bus/publisher.h"
#include "framework/core/diagnostics/printable.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/math/fnv.h"
#include "framework/walls/sound.h"

namespace presa {
namespace {

using walls::Stereo;

enum CaveCode { kTwoLeaders = 767 };

constexpr std::int64_t kListens = 300'000'000;       ///< before it leads: does another process lead? [ns]
constexpr std::int64_t kStateDue = 30'000'000;       ///< longest wait for the state of a frame [ns]
constexpr std::int64_t kFrozenPeriod = 100'000'000;  ///< between the pictures of a frozen wall [ns]
constexpr std::int64_t kTold = 5'000'000'000;        ///< how long another leader is told of [ns]

walls::Walls wallsOf(const std::string& file) {
  Diagnostics diagnostics;
  walls::Walls walls = walls::loadWalls(file, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  return walls;
}

/// Names from the bus, for a terminal.
std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) (all += all.empty() ? "" : ", ") += printable(name);
  return all;
}

/// The picture of another run keeps its own time: it would go on from that of the frame.
void showFrame(bus::RemotePicture& picture, const bus::WallFrame& frame) {
  if (picture.run() == frame.run) picture.showAt(frame.time);
}

template <class... Values>
std::string print(const char* format, Values... values) {
  std::array<char, 400> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

std::uint64_t drawnState(const ObjectState& objects) {
  Fnv1a hash;
  for (std::int32_t body = 0; body < objects.count(); ++body) {
    const Pose X = objects.poseAt(body, objects.time_end);
    for (const double x : {X.p.x(), X.p.y(), X.p.z(), X.q.w(), X.q.x(), X.q.y(), X.q.z()})
      hash.addWord(std::bit_cast<std::uint64_t>(x));
  }
  return hash.value();
}

Cave::Cave(const CaveSettings& settings, const BusSettings& bus)
    : settings_(settings),
      walls_(wallsOf(settings.walls)),
      wall_(settings.wall.empty() ? nullptr : &walls_.wall(settings.wall)),
      link_(bus::openWallLink(bus)),
      id_(bus::newRunId()) {
  if (!settings_.head.empty()) {
    head_ = std::make_unique<HeadTracker>(settings_.head, walls_.X_KHead);
    leader_.emplace(id_);
  }
  if (wall_ == nullptr) return;
  follower_.emplace(id_, wall_->name, walls_.X_KHead);
  canvas_.width = wall_->width;
  canvas_.height = wall_->height;
  canvas_.stereo = settings_.stereo;
  look(walls_.X_KHead);
}

void Cave::look(const Pose& X_KHead) {
  std::array<Vec3, 2> eyes{X_KHead.p, X_KHead.p};
  if (canvas_.stereo != Stereo::kMono && !canvas_.quad_refused) eyes = walls::eyesOf(walls_, X_KHead);
  const auto left = walls::frustumOf(walls_, *wall_, eyes[0]), right = walls::frustumOf(walls_, *wall_, eyes[1]);
  behind_wall_ = !left || !right;
  if (!behind_wall_) canvas_.eyes = {*left, *right};
}

bool Cave::next(bus::RemotePicture& picture, std::int64_t now_ns) {
  if (begin_ns_ == 0) begin_ns_ = now_ns;
  hear(now_ns);
  if (leader_ && now_ns - begin_ns_ > kListens) lead(picture, now_ns);
  return follower_ && follow(picture, now_ns);
}

void Cave::hear(std::int64_t now_ns) {
  const bus::WallLink::Arrived arrived = link_->take();
  for (const bus::WallFrame& frame : arrived.frames) {
    if (frame.leader == id_) continue;  // heard when it was sent
    if (leader_)
      hearOtherLeader(frame, now_ns);
    else if (follower_)
      follower_->hear(frame, now_ns);
  }
  if (!leader_) return;
  for (const bus::WallDrawn& drawn : arrived.drawn) {
    if (drawn.sender == id_) continue;
    const bool taken = leader_->hear(drawn, now_ns);
    if (taken && leader_->frames() == 0 && drawn.number > 0) head_->startFrom(drawn.X_KHead);
  }
}

// Once it leads, no other process ends it: the walls follow the leader that they heard first.
void Cave::hearOtherLeader(const bus::WallFrame& frame, std::int64_t now_ns) {
  if (!walls::isSound(frame)) return;
  if (leader_->frames() == 0)
    refuse(kTwoLeaders, "--head", "another process leads these walls already",
           "one process has --head; another CAVE needs another --domain");
  other_leader_ns_ = now_ns;
}

void Cave::lead(const bus::RemotePicture& picture, std::int64_t now_ns) {
  const Pose& head = head_->update(picture.time(), now_ns);
  if (picture.state() == bus::RemotePicture::State::kWaiting) return;
  if (now_ns - announced_ns_ >= period() && leader_->ready(now_ns)) {
    announced_ns_ = now_ns;
    const bus::WallFrame& frame = leader_->next(picture.run(), picture.time(), head, !head_->lost(), now_ns);
    link_->send(frame);
    if (follower_) follower_->hear(frame, now_ns);
    if (frames_++ == 0) first_ns_ = now_ns;
    last_ns_ = now_ns;
  } else if (const bus::WallFrame* frame = leader_->again(now_ns)) {
    link_->send(*frame);
    if (follower_) follower_->hear(*frame, now_ns);
  }
}

// A wall without a leader shows the run by itself; one that has lost its leader shows the last frame.
bool Cave::follow(bus::RemotePicture& picture, std::int64_t now_ns) {
  // a wall greets once its first picture is drawn, which takes long: until then nobody should wait for it
  if (const bus::WallDrawn* answer = drew_ ? follower_->again(now_ns) : nullptr) {
    if (leader_ && answer->number > 0) leader_->hear(*answer, now_ns);
    link_->send(*answer);
  }
  if (!follower_->led()) return now_ns - last_ns_ >= period();
  const bus::WallFrame& frame = follower_->frame();
  frozen_ = drew_ && follower_->due() == nullptr && follower_->leaderLost(now_ns);
  if (!drew_ || follower_->due() == nullptr) {
    showFrame(picture, frame);
    return !drew_ || (frozen_ && now_ns - last_ns_ >= kFrozenPeriod);
  }
  if (waits_since_ns_ == 0) waits_since_ns_ = now_ns;
  const bool here = picture.run() == frame.run && picture.newest() >= frame.time;
  if (!here && now_ns - waits_since_ns_ < kStateDue) return false;
  if (!here) ++late_;
  waits_since_ns_ = 0;
  showFrame(picture, frame);
  look(frame.X_KHead);
  shows_due_ = true;
  return true;
}

void Cave::drawn(std::uint64_t state, std::int64_t now_ns) {
  drew_ = true;
  if (!leader_) {
    if (frames_ == 0) first_ns_ = now_ns;
    last_ns_ = now_ns;
    ++frames_;
  }
  if (!shows_due_) return;
  shows_due_ = false;
  const bus::WallDrawn& answer = follower_->drawn(state, now_ns);
  link_->send(answer);
  if (leader_) leader_->hear(answer, now_ns);
}

double Cave::frameRate() const {
  return frames_ < 2 ? 0 : 1e9 * static_cast<double>(frames_ - 1) / static_cast<double>(last_ns_ - first_ns_);
}

std::string Cave::line(std::int64_t now_ns) const {
  std::string text;
  if (leader_) {
    const std::vector<std::string> present = leader_->present();
    text = "leads " + (present.empty() ? "no wall yet" : joined(present)) + print(", %.1f frames/s", frameRate());
    if (head_->lost()) text += ", HEAD LOST: it stays where it was";
    if (other_leader_ns_ != 0 && now_ns - other_leader_ns_ < kTold)
      text += ", ANOTHER LEADER is ignored: only one process has --head";
  } else if (!follower_->led()) {
    text = "no leader: this wall runs alone";
  } else if (follower_->leaderLost(now_ns)) {
    text = "LEADER LOST: the wall is frozen";
  } else {
    text = print("in step, %.1f frames/s", frameRate());
    if (!follower_->frame().tracked) text += ", HEAD LOST: it stays where it was";
  }
  if (wall_ != nullptr) text = "wall " + wall_->name + ": " + text;
  if (behind_wall_) text += ", the eye is behind the wall: drawn from its last place before it";
  if (canvas_.quad_refused) text += ", no quad-buffered stereo here: one picture for both eyes";
  return text;
}

std::string Cave::summary() const {
  std::string text;
  if (wall_ != nullptr && !leader_)
    text =
        print("wall %s: %llu frames, %.1f a second, %llu of them before their state had arrived", wall_->name.c_str(),
              static_cast<unsigned long long>(frames_), frameRate(), static_cast<unsigned long long>(late_));
  if (leader_)
    text = print(
        "led %llu frames, %.1f a second, of walls %s; left a wall behind %llu times; %llu frames with different "
        "states; head lost %u times",
        static_cast<unsigned long long>(frames_), frameRate(),
        leader_->present().empty() ? "none" : joined(leader_->present()).c_str(),
        static_cast<unsigned long long>(leader_->leftBehind()), static_cast<unsigned long long>(leader_->differing()),
        head_->losses());
  return text;
}

}  // namespace presa
