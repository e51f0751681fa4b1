#pragma once

/// Text of config/schema/printed.xsd, embedded at build time.
namespace presa::schemas {
extern const char* const printed;
}  // namespace presa::schemas
