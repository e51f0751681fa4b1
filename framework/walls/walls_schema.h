#pragma once

/// Text of config/schema/walls.xsd, embedded at build time.
namespace presa::schemas {
extern const char* const walls;
}  // namespace presa::schemas
