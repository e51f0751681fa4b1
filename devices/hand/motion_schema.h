#pragma once

/// Text of config/schema/motion.xsd, embedded at build time.
namespace presa::schemas {
extern const char* const motion;
}  // namespace presa::schemas
