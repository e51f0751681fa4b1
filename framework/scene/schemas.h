#pragma once
/// Texts of config/schema/*.xsd, embedded at build time.
namespace presa::schemas {
extern const char* const scene;
extern const char* const rig;
extern const char* const motion;
extern const char* const accuracy_cost;
extern const char* const experiment;
extern const char* const temple;
extern const char* const words;
}  // namespace presa::schemas
