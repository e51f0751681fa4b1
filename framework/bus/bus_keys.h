#pragma once
#include <string>

#include "framework/scene/scene.h"

/// Access control on a network: one certificate authority and one certificate for each role (run, viewer, commander).
/// Without a certificate nobody joins, reads or forges anything; a viewer cannot command, and neither viewer nor
/// commander can impersonate a run.
namespace presa::bus {

/// The files in the folder of one role, as `presa bus keys` writes them.
struct KeyFiles {
  std::string authority;    ///< certificate of the authority
  std::string certificate;  ///< certificate of this process, signed by the authority
  std::string key;          ///< private key of this process; readable by its owner only
  std::string governance;   ///< DDS security governance (which protection applies), signed
  std::string permissions;  ///< topics that this role may publish and subscribe to, signed
};

/// Throws InputError E753: a file is missing, or others may read the key.
KeyFiles checkedKeys(const std::string& folder);

/// Writes `folder`/authority, with the signing key, and `folder`/run, /viewer and /commander, each with the files
/// above, valid for ten years. The authority's key is needed again only to add machines. Throws InputError E754: the
/// folder exists already or cannot be written.
void makeKeys(const std::string& folder);

/// Throws InputError E752 when commands are enabled on a non-loopback network without keys.
void requireKeysForCommands(const BusSettings& settings);

}  // namespace presa::bus
