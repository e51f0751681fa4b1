#pragma once
#include <optional>
#include <string>

#include "apps/experiment/session_log.h"

/// The seal of a session is the sum of its log's last record: it covers the log, and by the sums in it every file. Whoever alters a session
/// can make all sums anew; whoever does not hold the key of the laboratory cannot sign the new seal. Thread: main.
namespace presa::experiment {

inline constexpr const char* kSignatureFile = "seal.json";

/// Writes `file` (the secret key, for its owner alone) and `file`.pub. Throws InputError E696 when one is there already.
void makeKeyFiles(const std::string& file);

/// Writes seal.json into the folder, over an older one. Throws InputError E697 when `key` is no secret key.
void signSeal(const SessionFolder& folder, const std::string& seal, const std::string& key);

/// What is wrong with the signature of this seal; none: the key's holder signed it. Throws InputError E697 when `key` is no public key.
std::optional<std::string> signatureTrouble(const SessionFolder& folder, const std::string& seal,
                                            const std::string& key);

}  // namespace presa::experiment
