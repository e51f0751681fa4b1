#pragma once
#include <string>
#include <vector>

#include "framework/core/schedule/tick.h"

namespace presa {

class InPortBase;
class OutPortBase;

/// An effect or plug-in that a run leaves out, and the reason.
struct LeftOut {
  std::string what, why;
};

/// A node of the graph: constant parameters, plain state, ports as members. Ports register with the module in their
/// constructors, the builder connects them, and build() freezes the connections.
class Module {
 public:
  Module(std::string name, RateGroup group) : name_(std::move(name)), group_(group) {}
  virtual ~Module() = default;
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;

  const std::string& name() const noexcept { return name_; }
  RateGroup group() const noexcept { return group_; }
  const std::vector<InPortBase*>& inputs() const noexcept { return inputs_; }
  const std::vector<OutPortBase*>& outputs() const noexcept { return outputs_; }

  /// Called once before the first step, on the group's thread. May allocate; an exception ends the run.
  virtual void start() {}
  /// One tick: read inputs, write outputs. In the haptic group: no allocation, lock, exception, text or system call.
  virtual void step(const Tick& tick) noexcept = 0;
  /// Called once after the last step, on the same thread.
  virtual void stop() {}
  /// Stages of one step, in order, for `presa explain`.
  virtual std::vector<std::string> stages() const { return {}; }
  /// Effects that this module can have but the scene does not call for.
  virtual std::vector<LeftOut> leftOut() const { return {}; }

 private:
  friend class InPortBase;
  friend class OutPortBase;
  std::string name_;
  RateGroup group_;
  std::vector<InPortBase*> inputs_;
  std::vector<OutPortBase*> outputs_;
};

}  // namespace presa
