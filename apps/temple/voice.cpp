#include "apps/temple/voice.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

#include "framework/input/on_path.h"

extern char** environ;

namespace presa::temple {
namespace {

constexpr const char* kProgram = "espeak-ng";
constexpr const char* kWordsPerMinute = "150";  // slower than its default of 175: visitors read along

}  // namespace

void Voice::check(Diagnostics& diagnostics) {
  if (input::isOnPath(kProgram)) return;
  diagnostics.error(965, {"--voice", 0, 0}, "sentences are read aloud by espeak-ng, which is not on the PATH",
                    "install it (Debian: espeak-ng), or leave out --voice");
}

Voice::~Voice() { stop(); }

void Voice::say(const std::string& sentence) {
  if (sentence.empty() || sentence == said_) return;
  stop();
  said_ = sentence;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // no sound card is no fault of the visit
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  const std::array<const char*, 8> words{kProgram,        "-v", language_.c_str(), "-s",
                                         kWordsPerMinute, "--", sentence.c_str(),  nullptr};
  if (posix_spawnp(&speaker_, kProgram, &actions, nullptr, const_cast<char**>(words.data()), environ) != 0)
    speaker_ = -1;
  posix_spawn_file_actions_destroy(&actions);
}

void Voice::stop() {
  if (speaker_ < 0) return;
  kill(speaker_, SIGTERM);
  while (waitpid(speaker_, nullptr, 0) < 0 && errno == EINTR) {
  }
  speaker_ = -1;
}

}  // namespace presa::temple
