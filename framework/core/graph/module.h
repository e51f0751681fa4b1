#pragma once
#include <string>
#include <vector>

#include "framework/core/schedule/tick.h"

namespace presa {

class InPortBase;
class OutPortBase;

/// Something that a run does without.
struct LeftOut {
  std::string what, why;
};

/// A node of the graph: constant parameters, plain state, ports as members. Ports declare themselves in the
/// constructor, the builder connects them, and after build() nothing changes any more.
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

  /// Once before the first step, on the thread that will call step. May allocate and throw.
  virtual void start() {}
  /// One tick. In the haptic group: no allocation, lock, exception, text or system call.
  virtual void step(const Tick& tick) noexcept = 0;
  /// Once after the last step, on the same thread.
  virtual void stop() {}
  /// What one step does, in order, for `presa explain`.
  virtual std::vector<std::string> stages() const { return {}; }
  /// Effects this module could have and the scene does not call for.
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
