#include "framework/geometry/mesh_import_plugin/isolation.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>

#include "framework/geometry/large_pages.h"

namespace presa {
namespace {

/// The arrays of a mesh, in the order in which they go through the pipe.
template <class Visit>
bool eachArray(RawMesh& mesh, const Visit& visit) {
  RawModel& model = mesh.model;
  return visit(mesh.problem) && visit(mesh.help) && visit(mesh.coordinates) && visit(mesh.indices) &&
         visit(model.vertices) && visit(model.corners) && visit(model.parts) && visit(model.materials) &&
         visit(model.textures) && visit(model.text) && visit(model.missing_library) && visit(mesh.attributes.names) &&
         visit(mesh.attributes.part_of) && visit(mesh.attributes.grey);
}

bool writeAll(int descriptor, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool readAll(int descriptor, void* data, std::size_t size) {
  char* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t got = read(descriptor, bytes, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

bool send(int descriptor, RawMesh& mesh) {
  return writeAll(descriptor, &mesh.ignored_faces, sizeof mesh.ignored_faces) &&
         writeAll(descriptor, &mesh.code, sizeof mesh.code) && eachArray(mesh, [&](const auto& array) {
           const std::uint64_t count = array.size();
           return writeAll(descriptor, &count, sizeof count) &&
                  writeAll(descriptor, array.data(), count * sizeof *array.data());
         });
}

bool receive(int descriptor, RawMesh& mesh) {
  return readAll(descriptor, &mesh.ignored_faces, sizeof mesh.ignored_faces) &&
         readAll(descriptor, &mesh.code, sizeof mesh.code) && eachArray(mesh, [&](auto& array) {
           std::uint64_t count = 0;
           if (!readAll(descriptor, &count, sizeof count)) return false;
           array.resize(count);
           return readAll(descriptor, array.data(), count * sizeof *array.data());
         });
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;  // sanitizers reserve terabytes of shadow memory
#else
constexpr bool kLimitsMemory = true;
#endif

/// Writable memory that this process has mapped already [bytes]; the child's limit is added to it.
std::size_t mappedData() {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  for (int field = 0; field < 6; ++field) statm >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource resource, std::size_t value) {
  rlimit wanted{};
  getrlimit(resource, &wanted);
  wanted.rlim_cur = std::min<rlim_t>(value, wanted.rlim_max);
  setrlimit(resource, &wanted);
}

/// Processor time of this process, rounded up [s]; a child that has just begun has used none.
std::size_t secondsUsed() {
  using std::chrono::seconds, std::chrono::microseconds, std::chrono::milliseconds;
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto sum = seconds(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                   microseconds(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  return sum < milliseconds(20) ? 0 : static_cast<std::size_t>(std::chrono::ceil<seconds>(sum).count());
}

/// Runs one read; what it allocates is counted from the memory that was mapped before the first.
void work(const IsolatedRead& read, std::size_t mapped, RawMesh& mesh) {
  limit(RLIMIT_CPU, secondsUsed() + read.limits.seconds);
  if (kLimitsMemory) limit(RLIMIT_DATA, mapped + read.limits.memory);
  try {
    read.work(mesh);
  } catch (const std::bad_alloc&) {
    mesh = {};
    mesh.problem = "the file claims more data than it holds";
  } catch (const std::exception& error) {
    mesh = {};
    mesh.problem = error.what();
  }
}

[[noreturn]] void child(int descriptor, const IsolatedRead* begin, const IsolatedRead* end) {
  // messages of a crashing reader would hide the finding that names the file
  if (const int null = open("/dev/null", O_WRONLY); null >= 0) dup2(null, STDERR_FILENO);
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGINT, SIGTERM, SIGHUP})
    std::signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // die with the parent
  limit(RLIMIT_CORE, 0);
  const std::size_t mapped = mappedData();
  growHeapInLargePages(1);  // assimp clears 16 MB for each OBJ
  bool heard = true;
  for (const IsolatedRead* read = begin; read != end && heard; ++read) {
    RawMesh mesh;
    work(*read, mapped, mesh);
    heard = send(descriptor, mesh);
  }
  _exit(0);  // run neither destructors nor exit handlers of the parent
}

std::string causeOfDeath(int status) {
  if (!WIFSIGNALED(status)) return "the reader gave up";
  if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL) return "the reader did not finish in time";
  return std::string("the reader crashed on it (") + strsignal(WTERMSIG(status)) + ")";
}

void refuse(RawMesh& mesh, std::string problem) {
  mesh = {};
  mesh.problem = std::move(problem);
}

/// Runs reads in one child until it ends; returns the first that is not settled.
const IsolatedRead* runInOneChild(const IsolatedRead* begin, const IsolatedRead* end) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    refuse(*begin->mesh, std::string("no pipe for the reader: ") + std::strerror(errno));
    return begin + 1;
  }
  const pid_t process = fork();
  if (process == 0) {
    close(ends[0]);
    child(ends[1], begin, end);
  }
  const int reason = errno;
  close(ends[1]);
  const IsolatedRead* next = begin;
  while (process > 0 && next != end && receive(ends[0], *next->mesh)) ++next;
  close(ends[0]);
  int status = 0;
  while (process > 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (next == end) return end;
  refuse(*next->mesh,
         process > 0 ? causeOfDeath(status) : std::string("no process for the reader: ") + std::strerror(reason));
  return next + 1;
}

}  // namespace

void runIsolated(const std::vector<IsolatedRead>& reads) {
  const IsolatedRead* const end = reads.data() + reads.size();
  for (const IsolatedRead* next = reads.data(); next != end;) next = runInOneChild(next, end);
}

}  // namespace presa
