#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "devices/falcon_model/serial_line.h"

namespace presa::falcon_model {

/// 16 bytes from the host: `<`, three words, what is lit and sought, one byte of no meaning, `>`.
struct Request {
  std::array<int, 3> counts{};
  bool homing = false, green = false, blue = false, red = false;
};
/// What goes back.
struct Status {
  std::array<int, 3> counters{};
  unsigned homed = 0;    ///< a bit for each encoder
  unsigned buttons = 0;  ///< plus 1, forward 2, centre 4, minus 8
};

inline constexpr std::size_t kFrame = 16;
using Frame = std::array<std::uint8_t, kFrame>;

/// Nothing: not a request. A word may say more than a motor can do: that is for others to judge.
std::optional<Request> requestOf(const Frame& frame);
Frame frameOf(const Request& request);  ///< for tests
/// `meaningless`: byte 14, of which nobody knows what it says.
Frame frameOf(const Status& status, std::uint8_t meaningless);
/// What a host may rightly read from these bytes; nothing: no reply.
std::optional<Status> statusOf(std::span<const std::uint8_t> bytes);

/// Something goes wrong in an upload; both are counted from 0.
struct UploadFault {
  enum class Kind : std::uint8_t {
    kCorruptByte,  ///< arrives changed, is echoed as it arrived
    kWrongEcho,    ///< only the echo is changed
    kLostEcho,
  };
  int attempt = 0;
  std::size_t byte = 0;
  Kind kind = Kind::kCorruptByte;
};

struct LoaderSettings {
  std::vector<std::uint8_t> firmware;  ///< the one that runs; any other is echoed and then hangs
  std::vector<UploadFault> faults;
  int deaf_greetings = 0;     ///< these first ones get no answer
  bool zero_before = false;   ///< the answer to the greeting begins with a 00
  bool refuses_load = false;  ///< no answer to the 41 that asks for a load
  double start = 0.005;       ///< from the last byte to the first request that is heard [s]
};

/// The device's processor: silent after power-on, boot loader after a rising edge of DTR while RTS is low, and in operation when the whole
/// firmware has arrived. Each stage hears only its own rate. Thread: the owner's.
class Processor {
 public:
  explicit Processor(const LoaderSettings& loader) : loader_(loader) {}

  enum class State : std::uint8_t { kSilent, kBootLoader, kGreeted, kUpload, kHung, kOperating };
  void switchOn(bool has_firmware);
  void linesChanged(const SerialLine& line, bool dtr_before);
  /// Answers of the loader go onto the line; in operation a whole request is returned.
  std::optional<Request> hear(const WireByte& byte, SerialLine& line);

  State state() const { return state_; }
  int uploads() const { return uploads_; }       ///< begun so far
  int badFrames() const { return bad_frames_; }  ///< that looked like a request and were none
  int garbled() const { return garbled_; }       ///< bytes at a wrong rate

  static constexpr double kLoaderBaud = 9600, kUploadBaud = 3e6 / 21, kOperationBaud = 1.5e6;

 private:
  void greet(const WireByte& byte, SerialLine& line);
  void load(const WireByte& byte, SerialLine& line);
  std::optional<Request> assemble(std::uint8_t value);

  LoaderSettings loader_;
  State state_ = State::kSilent;
  std::vector<std::uint8_t> heard_;
  Frame frame_{};
  std::size_t filled_ = 0;
  double ready_at_ = 0;
  int greetings_ = 0, uploads_ = 0, bad_frames_ = 0, garbled_ = 0;
};

}  // namespace presa::falcon_model
