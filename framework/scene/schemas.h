#pragma once

/// Texts of the schemas in config/schema, embedded at build time.
namespace presa::schemas {
extern const char* const scene;
extern const char* const rig;
extern const char* const plugin;
}  // namespace presa::schemas
