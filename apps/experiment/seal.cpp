#include "apps/experiment/seal.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "apps/common/atomic_file.h"
#include "apps/common/file_text.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/record/checksum/signature.h"

namespace presa::experiment {
namespace {

enum Code { kKeyThere = 696, kNoKey = 697 };
constexpr std::uint64_t kMaxKey = 4096;
constexpr const char* kHelp = "presa experiment key FILE makes FILE, the secret key, and FILE.pub, the public one";

/// The signed message. Its prefix keeps a signature made for another purpose from passing as a session's.
std::string messageOf(const std::string& seal) { return "presa session seal\n" + seal + "\n"; }

/// Creates a file with `mode` from the start; never overwrites an existing one.
void writeNew(const std::string& file, const std::string& text, mode_t mode) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) refuse(kKeyThere, file, std::string("cannot be made: ") + std::strerror(errno));
  const bool written =
      ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && ::fsync(descriptor) == 0;
  const int error = errno;
  ::close(descriptor);
  if (written) return;
  ::unlink(file.c_str());
  throw std::system_error(error, std::generic_category(), "cannot write " + file);
}

template <class Use>
auto withKey(const std::string& file, Use use) {
  const std::string text = input::readOrRefuse(file, kMaxKey, kNoKey);
  try {
    return use(text);
  } catch (const std::invalid_argument& error) {
    refuse(kNoKey, file, error.what(), kHelp);
  }
}

}  // namespace

void makeKeyFiles(const std::string& file) {
  for (const std::string& name : {file, file + ".pub"}) {
    if (std::filesystem::exists(std::filesystem::symlink_status(name)))
      refuse(kKeyThere, name, "exists already: a key is never overwritten");
  }
  const KeyPair keys = makeKeys();
  writeNew(file, keys.secret, 0600);
  writeNew(file + ".pub", keys.open, 0644);
}

void signSeal(const SessionFolder& folder, const std::string& seal, const std::string& key) {
  const std::string signature =
      withKey(key, [&](const std::string& secret) { return signMessage(secret, messageOf(seal)); });
  writeFileAtomically(folder.file(kSignatureFile), Json{{"seal", seal}, {"ed25519", signature}}.dump(2) + "\n");
}

std::optional<std::string> signatureTrouble(const SessionFolder& folder, const std::string& seal,
                                            const std::string& key) {
  const std::string text = contentsOf(folder.file(kSignatureFile));
  const Json kept = Json::parse(text, nullptr, false);
  const bool readable = kept.is_object() && kept.contains("ed25519") && kept.at("ed25519").is_string();
  // read the key in any case: a bad key must not be reported as a missing signature
  const std::string signature = readable ? kept.at("ed25519").get<std::string>() : "";
  const bool good = withKey(key, [&](const std::string& open) { return isSignedBy(open, messageOf(seal), signature); });
  if (good) return std::nullopt;
  if (text.empty()) return "the session is not signed";
  return std::string(kSignatureFile) + ": is not the signature of this session by this key";
}

}  // namespace presa::experiment
