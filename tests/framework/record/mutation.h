#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace presa::record {

/// A short recording of two fingers and a free cube that was closed in order, made without running anything.
void writeSpecimen(const std::string& file, std::uint64_t ticks);

/// Changes values, lengths, attributes, links and storage of a recording as `bytes` say; any bytes say something.
void mutate(const std::string& file, const std::uint8_t* bytes, std::size_t count);

/// Reads a recording in both ways. Any file is refused with an InputError or is sound: as many fingers as it says, tables of one length,
/// times that rise, phases in range. One that is said to have its right checksum is the specimen. Returns what does not hold, or "".
/// `accepted`, when given: whether it was read.
std::string judge(const std::string& file, std::uint64_t specimen_ticks, bool* accepted = nullptr);

}  // namespace presa::record
