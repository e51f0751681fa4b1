#pragma once
#include <array>
#include <vector>

#include "modules/bus_dds/convert.h"
#include "modules/bus_dds/participant.h"

/// Writers and readers of the topics that are polled: commands, and the walls of a CAVE.
namespace presa::bus_dds {

inline Entity writerOf(const Participant& joined, const Entity& topic, const Qos& qos) {
  return checked(dds_create_writer(joined.participant, topic, qos.get(), nullptr), "a writer");
}
inline Entity readerOf(const Participant& joined, const Entity& topic, const Qos& qos) {
  return checked(dds_create_reader(joined.participant, topic, qos.get(), nullptr), "a reader");
}

template <class Topic>
void send(const Entity& writer, const Topic& sample) noexcept {
  dds_write(writer, &sample);
  dds_write_flush(writer);
}

/// Appends everything that has arrived; does not wait.
template <class Topic, class Sample>
void takeAll(const Entity& reader, std::vector<Sample>& into) {
  constexpr std::size_t kAtOnce = 64;
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos;
  for (;;) {
    samples[0] = nullptr;  // ask Cyclone to lend its own memory
    const dds_return_t count = dds_take(reader, samples.data(), infos.data(), kAtOnce, kAtOnce);
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      if (infos[i].valid_data) into.push_back(fromTopic(*static_cast<const Topic*>(samples[i])));
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

}  // namespace presa::bus_dds
