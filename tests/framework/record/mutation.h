#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace presa::record {

/// A short, complete recording of two fingers and a free cube, made without a simulation.
void writeSpecimen(const std::string& file, std::uint64_t ticks);

/// Changes values, lengths, attributes, links and storage of a recording as directed by `bytes`; every sequence is
/// valid.
void mutate(const std::string& file, const std::uint8_t* bytes, std::size_t count);

/// Reads a recording with both readers. A file is either refused with an InputError or sound: the stated number of
/// fingers, tables of one length, increasing times, phases in range; with a correct checksum it is the specimen.
/// Returns the violated property, or "". `accepted`, when given, receives whether the file was read.
std::string judge(const std::string& file, std::uint64_t specimen_ticks, bool* accepted = nullptr);

}  // namespace presa::record
