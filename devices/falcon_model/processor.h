#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "devices/falcon_model/serial_line.h"

namespace presa::falcon_model {

/// 16 bytes from the host: `<`, three words, a byte with lights and homing, an unused byte, `>`.
struct Request {
  std::array<int, 3> counts{};
  bool homing = false, green = false, blue = false, red = false;
};
/// The reply.
struct Status {
  std::array<int, 3> counters{};
  unsigned homed = 0;    ///< one bit per encoder
  unsigned buttons = 0;  ///< plus 1, forward 2, centre 4, minus 8
};

inline constexpr std::size_t kFrame = 16;
using Frame = std::array<std::uint8_t, kFrame>;

/// Decodes a request; nullopt for anything else. Words may exceed the motors' range, which others check.
std::optional<Request> requestOf(const Frame& frame);
Frame frameOf(const Request& request);  ///< for tests
/// `meaningless`: value of byte 14, whose meaning is unknown.
Frame frameOf(const Status& status, std::uint8_t meaningless);
/// Decodes a reply from a host's point of view; nullopt for anything else.
std::optional<Status> statusOf(std::span<const std::uint8_t> bytes);

/// A fault during an upload; attempt and byte count from 0.
struct UploadFault {
  enum class Kind : std::uint8_t {
    kCorruptByte,  ///< changed on arrival, echoed as it arrived
    kWrongEcho,    ///< only the echo is changed
    kLostEcho,
  };
  int attempt = 0;
  std::size_t byte = 0;
  Kind kind = Kind::kCorruptByte;
};

struct LoaderSettings {
  std::vector<std::uint8_t> firmware;  ///< the working firmware; any other is echoed and then hangs
  std::vector<UploadFault> faults;
  int deaf_greetings = 0;     ///< number of first greetings without an answer
  bool zero_before = false;   ///< the answer to the greeting starts with a 00
  bool refuses_load = false;  ///< no answer to the load command 41
  double start = 0.005;       ///< from the last byte until requests are received [s]
};

/// The device's processor: silent after power-on; boot loader after a rising edge of DTR while RTS is low; operating
/// once the whole firmware has arrived. Each stage receives only at its own baud rate. Thread: the owner's.
class Processor {
 public:
  explicit Processor(const LoaderSettings& loader) : loader_(loader) {}

  enum class State : std::uint8_t { kSilent, kBootLoader, kGreeted, kUpload, kHung, kOperating };
  void switchOn(bool has_firmware);
  void linesChanged(const SerialLine& line, bool dtr_before);
  /// Processes a received byte. The loader answers on the line; in operation, returns a complete request.
  std::optional<Request> hear(const WireByte& byte, SerialLine& line);

  State state() const { return state_; }
  int uploads() const { return uploads_; }       ///< started so far
  int badFrames() const { return bad_frames_; }  ///< frames that looked like a request but were invalid
  int garbled() const { return garbled_; }       ///< bytes received at a wrong rate

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
