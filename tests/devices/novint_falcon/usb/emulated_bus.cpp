#include "tests/devices/novint_falcon/usb/emulated_bus.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/ioctl.h>
// after sys/ioctl.h
#include <linux/usbdevice_fs.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <stdexcept>

namespace presa::falcon_model::test {
namespace {

constexpr std::uint8_t kIn = 0x81, kOut = 0x02;

constexpr const char* kDescriptors =
    "12010002000000080304"  // device: USB 2.00, class of the interface, 8 bytes at endpoint 0, vendor 0403
    "48cb0004010203"        // product cb48, strings 1 to 3
    "01"
    "0902200001010080"  // one configuration, one interface, powered by the bus
    "2d"
    "0904000002ffffff02"  // two endpoints
    "07058102400000"
    "07050202400000";

/// Threads created during its lifetime get real-time priority, so that the device is not delayed by other programs. No
/// effect when the system refuses.
class Prompt {
 public:
  Prompt() {
    pthread_getschedparam(pthread_self(), &policy_, &priority_);
    const sched_param first{.sched_priority = 90};  // above the drivers'
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &first);
  }
  ~Prompt() { pthread_setschedparam(pthread_self(), policy_, &priority_); }
  Prompt(const Prompt&) = delete;
  Prompt& operator=(const Prompt&) = delete;

 private:
  int policy_ = SCHED_OTHER;
  sched_param priority_{};
};

/// A string descriptor: length, type, UTF-16.
std::vector<std::uint8_t> stringDescriptor(unsigned index, int port) {
  if (index == 0) return {4, 3, 0x09, 0x04};
  const std::string texts[] = {"", "NOVINT", "FALCON HAPTIC", "FALCON" + std::to_string(port)};
  const std::string& text = texts[std::min(index, 3U)];
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(2 + 2 * text.size()), 3};
  for (const char c : text) bytes.insert(bytes.end(), {static_cast<std::uint8_t>(c), 0});
  return bytes;
}

usbdevfs_urb* urbOf(const UMockdevIoctlData* data) { return reinterpret_cast<usbdevfs_urb*>(data->data); }

std::string padded(int number) { return (number < 10 ? "00" : "0") + std::to_string(number); }

}  // namespace

EmulatedFalcon::EmulatedFalcon(UMockdevTestbed* testbed, int port, ModelSettings settings,
                               std::chrono::steady_clock::time_point epoch)
    : testbed_(testbed),
      port_(port),
      epoch_(epoch),
      node_("bus/usb/001/" + padded(port + 1)),
      path_("/devices/pci0000:00/usb1/1-" + std::to_string(port)),
      base_(umockdev_ioctl_base_new()),
      model_(std::move(settings)) {
  g_object_connect(base_.get(), "signal-after::handle-ioctl", G_CALLBACK(&EmulatedFalcon::handle), this, nullptr);
  addToSystem();
}

EmulatedFalcon::~EmulatedFalcon() {
  umockdev_testbed_detach_ioctl(testbed_, ("/dev/" + node_).c_str(), nullptr);
  const std::lock_guard lock(mutex_);
}

void EmulatedFalcon::addToSystem() {
  GError* error = nullptr;
  // first, so that the device can be opened as soon as it is announced
  const bool attached = umockdev_testbed_attach_ioctl(testbed_, ("/dev/" + node_).c_str(), base_.get(), &error);
  const std::string number = padded(port_ + 1), address = std::to_string(port_ + 1);
  const std::string device =
      "P: " + path_ + "\nN: " + node_ +
      "\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: DEVTYPE=usb_device\nE: BUSNUM=001\nE: DEVNUM=" + number +
      "\nE: DEVNAME=/dev/" + node_ + "\nA: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=" + address +
      "\\n\nA: speed=12\\n\nA: idVendor=0403\\n\nA: idProduct=cb48\\n\n" +
      "A: product=FALCON HAPTIC\\n\nH: descriptors=" + kDescriptors + "\n";
  if (!attached || !umockdev_testbed_add_from_string(testbed_, device.c_str(), &error)) {
    throw std::runtime_error(std::string("no emulated device: ") + (error != nullptr ? error->message : "?"));
  }
}

void EmulatedFalcon::unplug() {
  {
    const std::lock_guard lock(mutex_);
    model_.unplug(now());
    gone_ = true;
    owner_.reset();
    for (auto* list : {&in_, &out_}) {
      for (Urb& urb : *list) finish(std::move(urb), -ESHUTDOWN, 0);
      list->clear();
    }
  }
  umockdev_testbed_uevent(testbed_, ("/sys" + path_).c_str(), "remove");
  umockdev_testbed_remove_device(testbed_, ("/sys" + path_).c_str());
}

void EmulatedFalcon::plug() {
  umockdev_testbed_detach_ioctl(testbed_, ("/dev/" + node_).c_str(), nullptr);
  {
    const std::lock_guard lock(mutex_);
    model_.plug(now());
    gone_ = stalled_ = false;
    in_.clear();
    out_.clear();
    done_.clear();
  }
  addToSystem();
}

void EmulatedFalcon::stallBulk(bool stalled) {
  const std::lock_guard lock(mutex_);
  stalled_ = stalled;
}

gboolean EmulatedFalcon::handle(UMockdevIoctlBase* /*base*/, UMockdevIoctlClient* client, EmulatedFalcon* self) {
  return self->ioctl(client) ? TRUE : FALSE;
}

/// Releases a client that has closed the node or ended. umockdev does not notify, so it is checked at the next request.
void EmulatedFalcon::releaseIfGone() {
  if (!owner_ || umockdev_ioctl_client_get_connected(owner_.get())) return;
  for (auto* list : {&in_, &out_, &done_}) {
    std::erase_if(*list, [this](const Urb& urb) { return urb.client == owner_.get(); });
  }
  owner_.reset();
  model_.release();
}

bool EmulatedFalcon::ioctl(UMockdevIoctlClient* client) {
  const std::lock_guard lock(mutex_);
  switch (umockdev_ioctl_client_get_request(client)) {
    case USBDEVFS_GET_CAPABILITIES: {
      UMockdevIoctlData* arg = umockdev_ioctl_client_get_arg(client);
      const Object<UMockdevIoctlData> word(umockdev_ioctl_data_resolve(arg, 0, sizeof(guint32), nullptr));
      const guint32 can = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_BULK_CONTINUATION | USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                          USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      std::memcpy(word->data, &can, sizeof can);
      umockdev_ioctl_client_complete(client, 0, 0);
      return true;
    }
    case USBDEVFS_CLAIMINTERFACE:
    case USBDEVFS_DISCONNECT_CLAIM:  // there is no kernel driver to disconnect
      claim(client);
      return true;
    case USBDEVFS_RELEASEINTERFACE:
      if (owner_.get() == client) owner_.reset(), model_.release();
      umockdev_ioctl_client_complete(client, 0, 0);
      return true;
    case USBDEVFS_GETDRIVER:  // no kernel driver holds it
      umockdev_ioctl_client_complete(client, -1, ENODATA);
      return true;
    case USBDEVFS_CLEAR_HALT:
    case USBDEVFS_RESET:
    case USBDEVFS_RESETEP:
      umockdev_ioctl_client_complete(client, 0, 0);
      return true;
    case USBDEVFS_SUBMITURB:
      submit(client);
      return true;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      reap(client);
      return true;
    case USBDEVFS_DISCARDURB:
      discard(client);
      return true;
    default:
      return false;
  }
}

void EmulatedFalcon::claim(UMockdevIoctlClient* client) {
  if (gone_) return umockdev_ioctl_client_complete(client, -1, ENODEV);
  releaseIfGone();
  if (owner_.get() != client && !model_.claim()) return umockdev_ioctl_client_complete(client, -1, EBUSY);
  owner_.reset(static_cast<UMockdevIoctlClient*>(g_object_ref(client)));
  umockdev_ioctl_client_complete(client, 0, 0);
}

void EmulatedFalcon::submit(UMockdevIoctlClient* client) {
  if (gone_) return umockdev_ioctl_client_complete(client, -1, ENODEV);
  Urb urb;
  urb.urb.reset(umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(usbdevfs_urb), nullptr));
  const usbdevfs_urb* request = urbOf(urb.urb.get());
  urb.buffer.reset(umockdev_ioctl_data_resolve(urb.urb.get(), offsetof(usbdevfs_urb, buffer),
                                               static_cast<gsize>(request->buffer_length), nullptr));
  urb.client = client;
  urb.submitted = now();
  if (request->type == USBDEVFS_URB_TYPE_CONTROL) {
    control(std::move(urb));
  } else if (stalled_) {
    finish(std::move(urb), -EPIPE, 0);
  } else if (request->endpoint == kIn) {
    in_.push_back(std::move(urb));
  } else if (request->endpoint == kOut) {
    out_.push_back(std::move(urb));
  } else {
    finish(std::move(urb), -EPIPE, 0);
  }
  pump();
  umockdev_ioctl_client_complete(client, 0, 0);
}

void EmulatedFalcon::control(Urb urb) {
  std::uint8_t* setup = urb.buffer->data;
  const auto value = static_cast<std::uint16_t>(setup[2] | setup[3] << 8);
  if (setup[0] == 0x40) {
    const bool taken = model_.vendorRequest(setup[1], value, now());
    return finish(std::move(urb), taken ? 0 : -EPIPE, 0);
  }
  if (setup[0] == 0x80 && setup[1] == 6 && value >> 8 == 3) {
    const auto text = stringDescriptor(value & 0xFFU, port_);
    const std::size_t length = std::min<std::size_t>(text.size(), setup[6] | setup[7] << 8);
    std::copy_n(text.begin(), length, setup + 8);
    return finish(std::move(urb), 0, static_cast<int>(length));
  }
  finish(std::move(urb), -EPIPE, 0);
}

void EmulatedFalcon::pump() {
  const double time = now();
  while (!out_.empty()) {
    const Object<UMockdevIoctlData>& buffer = out_.front().buffer;
    const auto length = static_cast<std::size_t>(buffer->data_len);
    if (!model_.hostWrites({buffer->data, length}, time)) break;  // the converter is full
    finish(std::move(out_.front()), 0, static_cast<int>(length));
    out_.pop_front();
  }
  while (!in_.empty()) {
    const auto packet = model_.toHost(time, in_.front().submitted);
    if (!packet) break;
    std::uint8_t* data = in_.front().buffer->data;
    std::copy_n(SerialLine::kStatus, 2, data);
    for (std::size_t i = 0; i < packet->bytes.size(); ++i) data[2 + i] = packet->bytes[i].value;
    in_.front().brings = packet->bytes;
    finish(std::move(in_.front()), 0, static_cast<int>(2 + packet->bytes.size()));
    in_.pop_front();
  }
}

void EmulatedFalcon::finish(Urb urb, int status, int length) {
  usbdevfs_urb* result = urbOf(urb.urb.get());
  result->status = status;
  result->actual_length = length;
  done_.push_back(std::move(urb));
}

void EmulatedFalcon::reap(UMockdevIoctlClient* client) {
  if (!gone_) pump();
  const auto found = std::ranges::find(done_, client, &Urb::client);
  if (found == done_.end()) return umockdev_ioctl_client_complete(client, -1, gone_ ? ENODEV : EAGAIN);
  const double time = now();
  for (const WireByte& byte : found->brings) model_.hostHasRead(byte, time);
  UMockdevIoctlData* arg = umockdev_ioctl_client_get_arg(client);
  const Object<UMockdevIoctlData> pointer(umockdev_ioctl_data_resolve(arg, 0, sizeof(gpointer), nullptr));
  umockdev_ioctl_data_set_ptr(pointer.get(), 0, found->urb.get());
  const Urb kept = std::move(*found);
  done_.erase(found);
  umockdev_ioctl_client_complete(client, 0, 0);
}

void EmulatedFalcon::discard(UMockdevIoctlClient* client) {
  gulong address = 0;
  std::memcpy(&address, umockdev_ioctl_client_get_arg(client)->data, sizeof address);
  for (auto* list : {&in_, &out_}) {
    const auto found = std::ranges::find_if(*list, [&](const Urb& urb) { return urb.urb->client_addr == address; });
    if (found == list->end()) continue;
    finish(std::move(*found), -ENOENT, 0);
    list->erase(found);
    return umockdev_ioctl_client_complete(client, 0, 0);
  }
  umockdev_ioctl_client_complete(client, -1, EINVAL);
}

EmulatedBus::EmulatedBus() {
  const Prompt prompt;
  testbed_.reset(umockdev_testbed_new());
}

EmulatedFalcon& EmulatedBus::add(ModelSettings settings) {
  const int port = 1 + static_cast<int>(falcons_.size());
  return *falcons_.emplace_back(std::make_unique<EmulatedFalcon>(testbed_.get(), port, std::move(settings), epoch_));
}

}  // namespace presa::falcon_model::test
