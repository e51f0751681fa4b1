#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/math/spatial.h"
#include "framework/core/state/limits.h"

namespace presa {

/// What a plug-in gives.
enum class PluginKind {
  kForceEffect,
  kFrictionLaw,
  kRenderer,
  kSurfaceEffect,
  kBodyEffect,
  kViewPart,
  kModule,
  kDevice,
  kMethod,
  kMetric,
  kToolRenderer
};

/// An element of the scene, or of an experiment, that a plug-in brings, with the values that its manifest allows.
/// Defaults are filled in.
struct PluginElement {
  std::string plugin;                             ///< its name, from the manifest
  std::string element;                            ///< name of the element
  std::int32_t body = kNoBody;                    ///< index of the body in which it stands; kNoBody: in none
  std::map<std::string, std::string> attributes;  ///< values by name, with defaults
  SourceLocation where;                           ///< in the scene or experiment
  PluginKind kind = PluginKind::kForceEffect;     ///< of the plug-in
  std::int32_t material = -1;  ///< index of the material in which, or in whose `<friction>`, it stands; -1: in none

  /// Value of an attribute of type number, vector3, boolean or text; `text` of a file is its absolute path, or empty.
  /// Throws std::logic_error when the manifest has none of that name or type.
  double number(const std::string& attribute) const;
  Vec3 vector3(const std::string& attribute) const;             ///< three numbers
  bool boolean(const std::string& attribute) const;             ///< true, false
  const std::string& text(const std::string& attribute) const;  ///< of any type, as written
};

}  // namespace presa
