#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/novint_falcon/transport.h"

struct libusb_context;
struct libusb_device_handle;

namespace presa::falcon {

inline constexpr std::uint16_t kVendor = 0x0403, kProduct = 0xcb48;

enum class UsbProblem : std::uint8_t {
  kNone,
  kNoUsb,         ///< this system shows no USB devices at all
  kNoDevice,      ///< no Falcon is plugged in
  kNotThisOne,    ///< none with that serial number
  kSeveral,       ///< more than one, and no serial number says which
  kNoNode,        ///< seen on the bus, but without a file to open
  kNoPermission,  ///< that file may not be opened
  kKernelDriver,  ///< a driver of the kernel holds it and does not let go
  kBusy,          ///< another program holds it
  kFailed,        ///< anything else, in `detail`
};

/// A Falcon on the bus, and what keeps it from being opened.
struct UsbFalcon {
  std::string node{};    ///< "/dev/bus/usb/001/002"
  std::string port{};    ///< where it is plugged in: "1-2.3"
  std::string serial{};  ///< "" when it cannot be read
  std::string product{};
  UsbProblem problem = UsbProblem::kNone;
  std::string detail{};  ///< libusb's words
};

struct UsbFailure {
  UsbProblem problem = UsbProblem::kNone;
  std::string node{}, detail{};
  std::vector<UsbFalcon> present{};
};

/// An open and claimed device, with the libusb context it belongs to; closes both.
class UsbHandle {
 public:
  UsbHandle() = default;
  UsbHandle(std::shared_ptr<libusb_context> context, libusb_device_handle* handle)
      : context_(std::move(context)), handle_(handle) {}
  UsbHandle(UsbHandle&& other) noexcept;
  UsbHandle& operator=(UsbHandle&& other) noexcept;
  ~UsbHandle();

  libusb_context* context() const noexcept { return context_.get(); }
  libusb_device_handle* get() const noexcept { return handle_; }
  explicit operator bool() const noexcept { return handle_ != nullptr; }

 private:
  std::shared_ptr<libusb_context> context_;
  libusb_device_handle* handle_ = nullptr;
};

/// Every Falcon that is plugged in, each tried: opened, claimed and let go again. `bus`: kNone, kNoUsb or kFailed.
/// Thread: any but a real-time one; waits for the devices.
std::vector<UsbFalcon> listFalcons(UsbFailure& bus);

/// Opens and claims interface 0 of the one with that serial number or port ("" when there is only one).
UsbHandle openFalcon(const std::string& serial, UsbFailure& failure);

/// What is wrong, in one line without a full stop, and what to do ("" when there is nothing to say): the whole udev rule,
/// say, ready to be pasted.
std::string describe(const UsbFailure& failure, const std::string& serial);
std::string remedy(const UsbFailure& failure);

inline constexpr const char* kUdevFile = "/etc/udev/rules.d/60-presa-novint_falcon.rules";
inline constexpr const char* kUdevRule =
    R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0664", GROUP="plugdev")";

}  // namespace presa::falcon
