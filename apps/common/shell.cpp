#include "apps/common/shell.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace presa::shell {
namespace {

std::string restOf(std::FILE* stream) {
  std::string text;
  std::array<char, 512> part;
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), stream)) > 0;) text.append(part.data(), n);
  return text;
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

Outcome run(const std::string& command) {
  Outcome outcome;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> errors(std::tmpfile(), std::fclose);
  if (errors == nullptr) return outcome;
  // what is ignored stays ignored in the command
  const std::string line = "trap '' INT; { " + command + "; } 2>&" + std::to_string(::fileno(errors.get()));
  std::FILE* pipe = ::popen(line.c_str(), "r");
  if (pipe == nullptr) return outcome;
  outcome.out = restOf(pipe);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  std::rewind(errors.get());
  outcome.err = restOf(errors.get());
  return outcome;
}

}  // namespace presa::shell
