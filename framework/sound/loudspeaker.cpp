#include "framework/sound/loudspeaker.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <system_error>

#include "framework/input/on_path.h"

extern char** environ;

namespace presa::sound {
namespace {

constexpr int kChunk = kSampleRate / 100;
constexpr std::size_t kMostPending = 16 * kChunk;  // [byte]
constexpr double kAhead = 0.04;                    // samples are written this long before they are heard [s]

}  // namespace

bool Loudspeaker::available() {
  std::error_code none;
  for (const auto& device : std::filesystem::directory_iterator("/dev/snd", none)) {
    const std::string name = device.path().filename();
    if (name.starts_with("pcm") && name.ends_with('p')) return input::isOnPath(kPlayer);  // p: plays
  }
  return false;
}

Loudspeaker::Loudspeaker() {
  // a socket rather than a pipe: when the player has gone, writing to it raises no signal
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  const std::string rate = std::to_string(kSampleRate);
  const std::array<const char*, 12> words{
      kPlayer, "-q", "-t", "raw", "-f", "S16_LE", "-c", "1", "-r", rate.c_str(), "--buffer-time=60000", nullptr};
  if (posix_spawnp(&player_, kPlayer, &actions, nullptr, const_cast<char**>(words.data()), environ) != 0) player_ = -1;
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  stream_ = ends[0];
  const int room = 4 * kChunk * 2;
  setsockopt(stream_, SOL_SOCKET, SO_SNDBUF, &room, sizeof room);
  gone_ = player_ <= 0;
  if (player_ > 0) writer_ = std::thread([this] { write(); });
}

Loudspeaker::~Loudspeaker() {
  ends_ = true;
  if (writer_.joinable()) writer_.join();
  if (stream_ >= 0) close(stream_);
  if (player_ < 0) return;
  kill(player_, SIGTERM);
  while (waitpid(player_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Loudspeaker::play(const Strike& strike) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(strike);
}

void Loudspeaker::write() {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  std::vector<Strike> sounding;
  std::string pending;
  for (std::int64_t chunk = 0; !ends_; ++chunk) {
    const double begin = static_cast<double>(chunk * kChunk) / kSampleRate;
    std::this_thread::sleep_until(start + std::chrono::duration<double>(begin - kAhead));
    {
      const std::lock_guard lock(mutex_);
      for (Strike& strike : waiting_) {
        strike.time = begin;
        sounding.push_back(strike);
      }
      waiting_.clear();
    }
    std::erase_if(sounding, [&](const Strike& strike) { return begin > strike.time + strike.lasts(); });
    std::vector<float> samples(kChunk);
    for (const Strike& strike : sounding) strike.addTo(samples, begin);
    pending += pcmOf(samples);
    const ssize_t sent = send(stream_, pending.data(), pending.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) {
      gone_ = true;
      return;
    }
    pending.erase(0, static_cast<std::size_t>(std::max<ssize_t>(0, sent)));
    if (pending.size() > kMostPending) pending.resize(pending.size() % 2);  // lags: what is left of a sample stays
  }
}

}  // namespace presa::sound
