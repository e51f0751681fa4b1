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
  kNoUsb,         ///< this system shows no USB devices
  kNoDevice,      ///< no Falcon is plugged in
  kNotThisOne,    ///< no Falcon has that serial number
  kSeveral,       ///< several, and no serial number given
  kNoNode,        ///< on the bus, but without a device file
  kNoPermission,  ///< no permission for the device file
  kKernelDriver,  ///< held by a kernel driver that cannot be detached
  kBusy,          ///< held by another program
  kFailed,        ///< anything else, in `detail`
};

/// A Falcon on the bus, with the reason why it cannot be opened, if any.
struct UsbFalcon {
  std::string node{};    ///< "/dev/bus/usb/001/002"
  std::string port{};    ///< port: "1-2.3"
  std::string serial{};  ///< "" when it cannot be read
  std::string product{};
  UsbProblem problem = UsbProblem::kNone;
  std::string detail{};  ///< libusb's message
};

struct UsbFailure {
  UsbProblem problem = UsbProblem::kNone;
  std::string node{}, detail{};
  std::vector<UsbFalcon> present{};
};

/// An open and claimed device with its libusb context; closes both.
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

/// All connected Falcons; each is opened, claimed and released as a test. `bus`: kNone, kNoUsb or kFailed. Thread: not
/// a real-time one; waits for the devices.
std::vector<UsbFalcon> listFalcons(UsbFailure& bus);

/// Opens and claims interface 0 of the device with that serial number or port ("": the only one).
UsbHandle openFalcon(const std::string& serial, UsbFailure& failure);

/// Message in one line without a full stop; remedy(): advice for the user ("" without any), for example the udev rule
/// to paste.
std::string describe(const UsbFailure& failure, const std::string& serial);
std::string remedy(const UsbFailure& failure);

inline constexpr const char* kUdevFile = "/etc/udev/rules.d/60-presa-novint_falcon.rules";
inline constexpr const char* kUdevRule =
    R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", MODE="0664", GROUP="plugdev")";

}  // namespace presa::falcon
