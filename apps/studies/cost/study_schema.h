#pragma once

/// Text of config/schema/accuracy_cost.xsd, embedded at build time.
namespace presa::schemas {
extern const char* const accuracy_cost;
}  // namespace presa::schemas
