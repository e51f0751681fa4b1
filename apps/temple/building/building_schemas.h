#pragma once

/// Texts of config/schema/temple.xsd and words.xsd, embedded at build time.
namespace presa::schemas {
extern const char* const temple;
extern const char* const words;
}  // namespace presa::schemas
