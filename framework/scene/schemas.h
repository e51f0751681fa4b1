#pragma once

/// Texts of the schemas in config/schema, embedded at build time.
namespace presa::schemas {
extern const char* const scene;   ///< of scenes (scene.xsd), without the elements of plug-ins
extern const char* const rig;     ///< of rigs (rig.xsd)
extern const char* const plugin;  ///< of manifests (plugin.xsd)
}  // namespace presa::schemas
