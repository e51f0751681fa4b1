#include "devices/novint_falcon/usb_bus.h"

#include <libusb-1.0/libusb.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace presa::falcon {
namespace {

std::shared_ptr<libusb_context> makeContext(UsbFailure& failure) {
  libusb_context* context = nullptr;
  if (const int error = libusb_init(&context); error != 0) {
    failure.problem = UsbProblem::kNoUsb;
    failure.detail = libusb_strerror(static_cast<libusb_error>(error));
    return nullptr;
  }
  libusb_set_option(context, LIBUSB_OPTION_LOG_LEVEL, LIBUSB_LOG_LEVEL_NONE);
  return {context, libusb_exit};
}

/// The Falcons among all USB devices; owns the libusb device list.
class FalconList {
 public:
  explicit FalconList(libusb_context* context) {
    const ssize_t count = libusb_get_device_list(context, &list_);
    for (ssize_t i = 0; i < count; ++i) {
      libusb_device_descriptor descriptor{};
      if (libusb_get_device_descriptor(list_[i], &descriptor) == 0 && descriptor.idVendor == kVendor &&
          descriptor.idProduct == kProduct)
        falcons_.push_back(list_[i]);
    }
  }
  ~FalconList() {
    if (list_ != nullptr) libusb_free_device_list(list_, 1);
  }
  FalconList(const FalconList&) = delete;
  FalconList& operator=(const FalconList&) = delete;
  const std::vector<libusb_device*>& falcons() const { return falcons_; }

 private:
  libusb_device** list_ = nullptr;
  std::vector<libusb_device*> falcons_;
};

std::string nodeOf(libusb_device* device) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "/dev/bus/usb/%03d/%03d", libusb_get_bus_number(device),
                libusb_get_device_address(device));
  return text.data();
}

std::string portOf(libusb_device* device) {
  std::array<std::uint8_t, 8> ports{};
  const int depth = libusb_get_port_numbers(device, ports.data(), static_cast<int>(ports.size()));
  std::string text = std::to_string(libusb_get_bus_number(device));
  for (int i = 0; i < depth; ++i) text += (i == 0 ? "-" : ".") + std::to_string(ports[static_cast<std::size_t>(i)]);
  return text;
}

std::string stringOf(libusb_device_handle* handle, std::uint8_t index) {
  std::array<unsigned char, 128> text{};
  if (index == 0 || libusb_get_string_descriptor_ascii(handle, index, text.data(), text.size()) <= 0) return {};
  return reinterpret_cast<const char*>(text.data());
}

UsbProblem problemOfOpening(int error) {
  if (error == LIBUSB_ERROR_ACCESS) return UsbProblem::kNoPermission;
  if (error == LIBUSB_ERROR_NO_DEVICE || error == LIBUSB_ERROR_NOT_FOUND) return UsbProblem::kNoNode;
  return UsbProblem::kFailed;
}

void setProblem(UsbFalcon& falcon, UsbProblem problem, int error) {
  falcon.problem = problem;
  falcon.detail = libusb_strerror(static_cast<libusb_error>(error));
}

UsbHandle open(libusb_device* device, const std::shared_ptr<libusb_context>& context, UsbFalcon& falcon) {
  falcon.node = nodeOf(device);
  falcon.port = portOf(device);
  libusb_device_handle* handle = nullptr;
  if (const int error = libusb_open(device, &handle); error != 0) {
    setProblem(falcon, problemOfOpening(error), error);
    return {};
  }
  libusb_device_descriptor descriptor{};
  libusb_get_device_descriptor(device, &descriptor);
  falcon.product = stringOf(handle, descriptor.iProduct);
  falcon.serial = stringOf(handle, descriptor.iSerialNumber);
  return {context, handle};
}

void claim(libusb_device_handle* handle, UsbFalcon& falcon) {
  libusb_set_auto_detach_kernel_driver(handle, 1);
  int error = libusb_claim_interface(handle, 0);
  if (error == 0) return;
  if (error == LIBUSB_ERROR_BUSY) return setProblem(falcon, UsbProblem::kBusy, error);
  // the failed detach may mean that there is nothing to detach
  libusb_set_auto_detach_kernel_driver(handle, 0);
  error = libusb_claim_interface(handle, 0);
  if (error == 0) return;
  setProblem(falcon, error == LIBUSB_ERROR_BUSY ? UsbProblem::kKernelDriver : UsbProblem::kFailed, error);
}

/// Tries to open every Falcon; returns all of them, and the handles of the open ones.
std::vector<UsbFalcon> openAll(UsbFailure& failure, std::vector<UsbHandle>& handles) {
  const auto context = makeContext(failure);
  if (!context) return {};
  const FalconList list(context.get());
  std::vector<UsbFalcon> falcons;
  for (libusb_device* device : list.falcons()) handles.push_back(open(device, context, falcons.emplace_back()));
  std::error_code ignored;
  if (falcons.empty() && !std::filesystem::exists("/dev/bus/usb", ignored)) {
    failure.problem = UsbProblem::kNoUsb;
    failure.detail = "there is no folder /dev/bus/usb";
  }
  return falcons;
}

void blame(const UsbFalcon& falcon, UsbFailure& failure) {
  failure.problem = falcon.problem;
  failure.node = falcon.node;
  failure.detail = falcon.detail;
}

}  // namespace

UsbHandle::UsbHandle(UsbHandle&& other) noexcept
    : context_(std::move(other.context_)), handle_(std::exchange(other.handle_, nullptr)) {}

UsbHandle& UsbHandle::operator=(UsbHandle&& other) noexcept {
  std::swap(context_, other.context_);
  std::swap(handle_, other.handle_);
  return *this;
}

UsbHandle::~UsbHandle() {
  if (handle_ == nullptr) return;
  libusb_release_interface(handle_, 0);  // no effect if it was not claimed
  libusb_close(handle_);
}

std::vector<UsbFalcon> listFalcons(UsbFailure& bus) {
  std::vector<UsbHandle> handles;
  std::vector<UsbFalcon> falcons = openAll(bus, handles);
  for (std::size_t i = 0; i < falcons.size(); ++i)
    if (handles[i]) claim(handles[i].get(), falcons[i]);
  return falcons;
}

UsbHandle openFalcon(const std::string& serial, UsbFailure& failure) {
  std::vector<UsbHandle> handles;
  failure.present = openAll(failure, handles);
  std::vector<UsbFalcon>& falcons = failure.present;
  if (failure.problem != UsbProblem::kNone) return {};
  std::vector<std::size_t> fitting;
  for (std::size_t i = 0; i < falcons.size(); ++i)
    if (serial.empty() || falcons[i].serial == serial || falcons[i].port == serial) fitting.push_back(i);
  if (fitting.size() == 1) {
    UsbFalcon& falcon = falcons[fitting[0]];
    UsbHandle& handle = handles[fitting[0]];
    if (handle) claim(handle.get(), falcon);
    blame(falcon, failure);
    return falcon.problem == UsbProblem::kNone ? std::move(handle) : UsbHandle{};
  }
  failure.problem = fitting.size() > 1 ? UsbProblem::kSeveral
                    : falcons.empty()  ? UsbProblem::kNoDevice
                                       : UsbProblem::kNotThisOne;
  if (failure.problem != UsbProblem::kNotThisOne) return {};
  // the requested device may be one whose serial number could not be read
  for (const UsbFalcon& falcon : falcons)
    if (falcon.problem != UsbProblem::kNone) blame(falcon, failure);
  return {};
}

std::string describe(const UsbFailure& failure, const std::string& serial) {
  std::string found;
  for (const UsbFalcon& falcon : failure.present)
    found += (found.empty() ? "" : ", ") + (falcon.serial.empty() ? "port " + falcon.port : falcon.serial);
  switch (failure.problem) {
    case UsbProblem::kNone:
      return "no problem";
    case UsbProblem::kNoUsb:
      return "this system shows no USB devices (" + failure.detail + ")";
    case UsbProblem::kNoDevice:
      return "no Novint Falcon (0403:cb48) is plugged in";
    case UsbProblem::kNotThisOne:
      return "no Novint Falcon has the serial number or port '" + serial + "', found " + found;
    case UsbProblem::kSeveral:
      return "which Novint Falcon? There are " + std::to_string(failure.present.size()) + ": " + found;
    case UsbProblem::kNoNode:
      return "the Novint Falcon is on the bus, but " + failure.node + " cannot be opened (" + failure.detail + ")";
    case UsbProblem::kNoPermission:
      return "no permission to open " + failure.node;
    case UsbProblem::kKernelDriver:
      return "a driver of the kernel holds " + failure.node + " and cannot be detached";
    case UsbProblem::kBusy:
      return "another program holds " + failure.node;
    case UsbProblem::kFailed:
      return "USB fails at " + failure.node + ": " + failure.detail;
  }
  return {};
}

std::string remedy(const UsbFailure& failure) {
  switch (failure.problem) {
    case UsbProblem::kNoUsb:
      return "in a container or virtual machine: pass the USB bus through to it";
    case UsbProblem::kNoDevice:
      return "connect its USB cable and its power supply; lsusb -d 0403:cb48 must show it";
    case UsbProblem::kNotThisOne:
      return "correct the setting serial";
    case UsbProblem::kSeveral:
      return "add serial=\"…\" to the device of the rig: a serial number, or a port such as 1-2";
    case UsbProblem::kNoNode:
      return "unplug it and plug it in again";
    case UsbProblem::kNoPermission:
      return std::string("write this line to ") + kUdevFile + ", then plug the device in again: " + kUdevRule;
    case UsbProblem::kKernelDriver:
      return "sudo rmmod ftdi_sio";
    case UsbProblem::kBusy:
      return "end the other program (sudo fuser -v " + failure.node + " names it)";
    case UsbProblem::kNone:
    case UsbProblem::kFailed:
      break;
  }
  return {};
}

}  // namespace presa::falcon
