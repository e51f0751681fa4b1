#include "modules/view_osg/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

#include "framework/core/diagnostics/refuse.h"
#include "framework/input/on_path.h"

extern char** environ;

namespace presa::view {
namespace {

// of x264: 60 % of its default's time, for files a tenth larger that look the same
constexpr const char *kEffort = "veryfast", *kQuality = "20";
constexpr int kPipe = 1 << 20;  ///< capacity [byte]: a frame of 720 lines takes three of them

/// Writes without raising SIGPIPE, which an ffmpeg that ends early would send to the whole process.
bool writeAll(int pipe, const unsigned char* bytes, std::size_t count) {
  sigset_t broken, before;
  sigemptyset(&broken);
  sigaddset(&broken, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken, &before);
  while (count > 0) {
    const ssize_t done = ::write(pipe, bytes, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) break;
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
  const timespec now{};
  if (count > 0) sigtimedwait(&broken, nullptr, &now);  // removes a pending SIGPIPE before it is delivered
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return count == 0;
}

}  // namespace

Video::Video(const std::string& file, double rate) : file_(file), rate_(rate) {
  if (!input::isOnPath("ffmpeg"))
    refuse(705, "--video", "a video is made by ffmpeg, which is not on the PATH", "install it (Debian: ffmpeg)");
}

Video::~Video() { finish(); }

void Video::start(int width, int height) {
  width_ = width, height_ = height;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    trouble_ = std::string("no pipe to ffmpeg: ") + std::strerror(errno);
    return;
  }
  const std::string size = std::to_string(width) + "x" + std::to_string(height), rate = std::to_string(rate_);
  // OSG's rows start at the bottom; H.264 with chroma subsampling requires even sizes
  const std::array words{"ffmpeg",      "-y",
                         "-loglevel",   "error",
                         "-f",          "rawvideo",
                         "-pix_fmt",    "rgb24",
                         "-s",          size.c_str(),
                         "-r",          rate.c_str(),
                         "-i",          "-",
                         "-vf",         "vflip,crop=trunc(iw/2)*2:trunc(ih/2)*2",
                         "-pix_fmt",    "yuv420p",
                         "-preset",     kEffort,
                         "-crf",        kQuality,
                         "-f",          "mp4",
                         file_.c_str(), static_cast<const char*>(nullptr)};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  // Ctrl-C at the terminal goes to the group of the program: ffmpeg ends when the last frame has come
  posix_spawnattr_t apart;
  posix_spawnattr_init(&apart);
  posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP);
  const int failed =
      posix_spawnp(&process_, "ffmpeg", &actions, &apart, const_cast<char* const*>(words.data()), environ);
  posix_spawnattr_destroy(&apart);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  fcntl(pipe_, F_SETPIPE_SZ, kPipe);  // where the system refuses, its own size does
  if (failed == 0) return;
  process_ = -1;
  trouble_ = std::string("ffmpeg cannot be started: ") + std::strerror(failed);
}

void Video::add(const osg::Image& picture, double time) {
  if (process_ < 0 && trouble_.empty()) start(picture.s(), picture.t());
  if (picture.s() != width_ || picture.t() != height_) return;  // the window was resized
  while (due(time)) write(picture);
}

void Video::write(const osg::Image& picture) {
  ++written_;
  const std::size_t row = 3 * static_cast<std::size_t>(width_), rows = static_cast<std::size_t>(height_);
  const bool contiguous = picture.getRowStepInBytes() == row;
  for (std::size_t from = 0; from < rows && trouble_.empty(); from += contiguous ? rows : 1) {
    if (!writeAll(pipe_, picture.data(0, static_cast<unsigned>(from)), contiguous ? rows * row : row))
      trouble_ = "ffmpeg ended before the run";
  }
}

std::string Video::finish() {
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  if (process_ < 0) return trouble_.empty() ? "nothing was drawn" : trouble_;
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (trouble_.empty() && (!WIFEXITED(status) || WEXITSTATUS(status) != 0)) trouble_ = "ffmpeg could not write it";
  return trouble_;
}

}  // namespace presa::view
