#include "framework/bus/local_bus.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/bus/inbox.h"
#include "framework/core/schedule/clock.h"

namespace presa::bus {

struct LocalBus::Hub {
  explicit Hub(std::size_t max) : capacity(max) {}
  void send(const Inbox::Item& item) {
    const std::int64_t now = monotonicNs();
    for (Inbox* inbox : inboxes) inbox->put(item, now);
  }

  std::size_t capacity;
  std::mutex mutex;
  std::vector<Inbox*> inboxes;
  std::optional<RunInfo> run;  // kept for late readers
  std::vector<std::vector<Command>*> posts;
  std::vector<Commander::Replies*> commanders;
  std::vector<std::vector<GuideOrder>*> order_posts;
  std::vector<std::vector<GuideStatus>*> order_senders;
  std::map<std::pair<std::uint64_t, std::string>, OpenParameter> parameters;  // kept for late commanders
};

class LocalBus::LocalWriter final : public Writer {
 public:
  explicit LocalWriter(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {}
  void announce(const RunInfo& run) override {
    const std::lock_guard lock(hub_->mutex);
    hub_->run = run;
    hub_->send(run);
  }
  std::uint64_t publish(const Snapshot& snapshot) noexcept override {
    const std::lock_guard lock(hub_->mutex);
    for (const ObjectSample& sample : snapshot.objects) hub_->send(sample);
    for (const FingerSample& sample : snapshot.fingers) hub_->send(sample);
    for (const FrameSample& sample : snapshot.frames) hub_->send(sample);
    hub_->send(snapshot.heartbeat);
    return 0;
  }
  void publish(const Event& event) noexcept override {
    const std::lock_guard lock(hub_->mutex);
    hub_->send(event);
  }
  void finish() noexcept override {}

 private:
  std::shared_ptr<Hub> hub_;
};

class LocalBus::LocalReader final : public Reader {
 public:
  explicit LocalReader(std::shared_ptr<Hub> hub) : hub_(std::move(hub)), inbox_(hub_->capacity) {
    const std::lock_guard lock(hub_->mutex);
    hub_->inboxes.push_back(&inbox_);
    if (hub_->run) inbox_.put(*hub_->run, monotonicNs());
  }
  ~LocalReader() override {
    const std::lock_guard lock(hub_->mutex);
    std::erase(hub_->inboxes, &inbox_);
  }
  void expectFrames() override {}
  void take(Listener& listener) override { inbox_.take(listener); }
  void wait(double seconds) override { inbox_.wait(seconds); }
  std::uint64_t overrun() const override { return inbox_.overrun(); }

 private:
  std::shared_ptr<Hub> hub_;
  Inbox inbox_;
};

class LocalBus::LocalPost final : public CommandPost {
 public:
  explicit LocalPost(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
    const std::lock_guard lock(hub_->mutex);
    hub_->posts.push_back(&commands_);
  }
  ~LocalPost() override {
    const std::lock_guard lock(hub_->mutex);
    std::erase(hub_->posts, &commands_);
  }
  void show(const OpenParameter& parameter) noexcept override {
    const std::lock_guard lock(hub_->mutex);
    hub_->parameters[{parameter.run, parameter.name}] = parameter;
    for (Commander::Replies* replies : hub_->commanders) replies->parameters.push_back(parameter);
  }
  std::vector<Command> take() override {
    const std::lock_guard lock(hub_->mutex);
    return std::exchange(commands_, {});
  }
  void answer(const Answer& answer) noexcept override {
    const std::lock_guard lock(hub_->mutex);
    for (Commander::Replies* replies : hub_->commanders) replies->answers.push_back(answer);
  }

 private:
  std::shared_ptr<Hub> hub_;
  std::vector<Command> commands_;
};

class LocalBus::LocalCommander final : public Commander {
 public:
  explicit LocalCommander(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
    const std::lock_guard lock(hub_->mutex);
    hub_->commanders.push_back(&replies_);
    for (const auto& [key, parameter] : hub_->parameters) replies_.parameters.push_back(parameter);
  }
  ~LocalCommander() override {
    const std::lock_guard lock(hub_->mutex);
    std::erase(hub_->commanders, &replies_);
  }
  void send(const Command& command) override {
    const std::lock_guard lock(hub_->mutex);
    for (std::vector<Command>* post : hub_->posts) post->push_back(command);
  }
  Replies take() override {
    const std::lock_guard lock(hub_->mutex);
    return std::exchange(replies_, {});
  }

 private:
  std::shared_ptr<Hub> hub_;
  Replies replies_;
};

class LocalBus::LocalOrderPost final : public OrderPost {
 public:
  explicit LocalOrderPost(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
    const std::lock_guard lock(hub_->mutex);
    hub_->order_posts.push_back(&orders_);
  }
  ~LocalOrderPost() override {
    const std::lock_guard lock(hub_->mutex);
    std::erase(hub_->order_posts, &orders_);
  }
  void show(const GuideStatus& status) noexcept override {
    const std::lock_guard lock(hub_->mutex);
    for (std::vector<GuideStatus>* sender : hub_->order_senders) sender->push_back(status);
  }
  std::vector<GuideOrder> take() override {
    const std::lock_guard lock(hub_->mutex);
    return std::exchange(orders_, {});
  }

 private:
  std::shared_ptr<Hub> hub_;
  std::vector<GuideOrder> orders_;
};

class LocalBus::LocalOrderSender final : public OrderSender {
 public:
  explicit LocalOrderSender(std::shared_ptr<Hub> hub) : hub_(std::move(hub)) {
    const std::lock_guard lock(hub_->mutex);
    hub_->order_senders.push_back(&statuses_);
  }
  ~LocalOrderSender() override {
    const std::lock_guard lock(hub_->mutex);
    std::erase(hub_->order_senders, &statuses_);
  }
  void send(const GuideOrder& order) noexcept override {
    const std::lock_guard lock(hub_->mutex);
    for (std::vector<GuideOrder>* post : hub_->order_posts) post->push_back(order);
  }
  std::vector<GuideStatus> take() override {
    const std::lock_guard lock(hub_->mutex);
    return std::exchange(statuses_, {});
  }

 private:
  std::shared_ptr<Hub> hub_;
  std::vector<GuideStatus> statuses_;
};

LocalBus::LocalBus(std::size_t capacity) : hub_(std::make_shared<Hub>(capacity)) {}
LocalBus::~LocalBus() = default;
std::unique_ptr<Writer> LocalBus::writer() { return std::make_unique<LocalWriter>(hub_); }
std::unique_ptr<Reader> LocalBus::reader() { return std::make_unique<LocalReader>(hub_); }
std::unique_ptr<CommandPost> LocalBus::post() { return std::make_unique<LocalPost>(hub_); }
std::unique_ptr<Commander> LocalBus::commander() { return std::make_unique<LocalCommander>(hub_); }
std::unique_ptr<OrderPost> LocalBus::orderPost() { return std::make_unique<LocalOrderPost>(hub_); }
std::unique_ptr<OrderSender> LocalBus::orderSender() { return std::make_unique<LocalOrderSender>(hub_); }

}  // namespace presa::bus
