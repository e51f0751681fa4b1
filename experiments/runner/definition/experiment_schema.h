#pragma once

/// Text of config/schema/experiment.xsd, embedded at build time.
namespace presa::schemas {
extern const char* const experiment;
}  // namespace presa::schemas
