#pragma once
#include <string>

#include "framework/scene/scene.h"

/// Who may do what on a network: certificates of one authority, one for each part that a process plays. With them nobody without a
/// certificate joins, sees or forges anything; a viewer cannot command, and neither a viewer nor a commander can pass for a run.
namespace presa::bus {

/// In a folder of one part, as `presa bus keys` writes it.
struct KeyFiles {
  std::string authority;    ///< certificate of the authority
  std::string certificate;  ///< this process's, signed by the authority
  std::string key;          ///< its private key; nobody else on the machine may read it
  std::string governance;   ///< what is protected how, signed
  std::string permissions;  ///< which topics this part may publish and subscribe to, signed
};

/// Throws InputError E753: a file is missing, or others may read the key.
KeyFiles checkedKeys(const std::string& folder);

/// Writes `folder`/authority, with the key that signs, and `folder`/run, /viewer and /commander, each with the files above, for ten
/// years. The authority's key is not needed again, unless for another machine. Throws InputError E754: the folder is there already, or
/// cannot be written.
void makeKeys(const std::string& folder);

/// Throws InputError E752: commands on a network that others reach need keys. loopback needs none.
void requireKeysForCommands(const BusSettings& settings);

}  // namespace presa::bus
