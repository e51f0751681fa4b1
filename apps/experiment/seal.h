#pragma once
#include <optional>
#include <string>

#include "apps/experiment/session_log.h"

/// Signatures of sessions (Ed25519). The seal of a session is the SHA-256 of its log's last record; it covers the log
/// and, by the sums in the log, every file. A forger can recompute all sums, but cannot sign the new seal without the
/// laboratory's secret key. Thread: main.
namespace presa::experiment {

inline constexpr const char* kSignatureFile = "seal.json";

/// Writes `file` (the secret key, readable by its owner only) and `file`.pub. Throws InputError E696 when either
/// exists.
void makeKeyFiles(const std::string& file);

/// Signs `seal` and writes seal.json into the folder, over an older one. Throws InputError E697 when `key` is no secret
/// key.
void signSeal(const SessionFolder& folder, const std::string& seal, const std::string& key);

/// The problem with the signature of this seal; no value: the signature is valid. Throws InputError E697 when `key` is
/// no public key.
std::optional<std::string> signatureTrouble(const SessionFolder& folder, const std::string& seal,
                                            const std::string& key);

}  // namespace presa::experiment
