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
#include <span>
#include <thread>

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

[[noreturn]] void child(int descriptor, std::span<const IsolatedRead> reads) {
  // messages of a crashing reader would hide the finding that names the file
  if (const int null = open("/dev/null", O_WRONLY); null >= 0) dup2(null, STDERR_FILENO);
  for (const int number : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGINT, SIGTERM, SIGHUP})
    std::signal(number, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // die with the parent
  limit(RLIMIT_CORE, 0);
  const std::size_t mapped = mappedData();
  growHeapInLargePages(1);  // assimp clears 16 MB for each OBJ
  for (const IsolatedRead& read : reads) {
    RawMesh mesh;
    work(read, mapped, mesh);
    if (!send(descriptor, mesh)) break;
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

using Reads = std::span<const IsolatedRead>;

/// A child that runs `left` one after the other and sends the result of each.
struct Reader {
  Reads left;
  pid_t process = -1;
  int results = -1;     ///< where the child's results arrive
  std::string problem;  ///< why there is no child
};

Reader start(Reads reads) {
  Reader reader;
  reader.left = reads;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    reader.problem = std::string("no pipe for the reader: ") + std::strerror(errno);
    return reader;
  }
  reader.process = fork();
  if (reader.process == 0) {
    close(ends[0]);
    child(ends[1], reads);
  }
  if (reader.process < 0) reader.problem = std::string("no process for the reader: ") + std::strerror(errno);
  close(ends[1]);
  reader.results = ends[0];
  return reader;
}

/// Takes what the child sends, until it ends; the read that ended it is refused.
void receive(Reader& reader) {
  while (reader.process > 0 && !reader.left.empty() && receive(reader.results, *reader.left.front().mesh))
    reader.left = reader.left.subspan(1);
  if (reader.results >= 0) close(reader.results);
  int status = 0;
  while (reader.process > 0 && waitpid(reader.process, &status, 0) < 0 && errno == EINTR) {
  }
  if (reader.left.empty()) return;
  refuse(*reader.left.front().mesh, reader.process > 0 ? causeOfDeath(status) : reader.problem);
  reader.left = reader.left.subspan(1);
}

}  // namespace

void runIsolated(const std::vector<std::vector<IsolatedRead>>& groups) {
  std::vector<Reads> left(groups.begin(), groups.end());
  while (!left.empty()) {
    // All children start while no thread of this function runs: a lock that another thread holds at a fork is never
    // released in the child (the allocators of the sanitizers have such locks).
    std::vector<Reader> readers;
    for (const Reads& reads : left) readers.push_back(start(reads));
    left.clear();
    {
      std::vector<std::jthread> others;
      for (std::size_t i = 1; i < readers.size(); ++i) others.emplace_back([&reader = readers[i]] { receive(reader); });
      receive(readers.front());
    }
    for (const Reader& reader : readers)
      if (!reader.left.empty()) left.push_back(reader.left);
  }
}

}  // namespace presa
