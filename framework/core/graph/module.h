#pragma once
#include <string>
#include <vector>

#include "framework/core/schedule/tick.h"

namespace presa {

class InPortBase;
class OutPortBase;

/// An effect or plug-in that a run leaves out, and the reason.
struct LeftOut {
  std::string what,  ///< for example "changing friction"
      why;           ///< for example "no touchable material …"
};

/// A node of the graph: constant parameters, plain state, ports as members. Ports register with the module in their
/// constructors, the builder connects them, and build() freezes the connections.
class Module {
 public:
  Module(std::string name, RateGroup group) : name_(std::move(name)), group_(group) {}  ///< a unique name (E505)
  virtual ~Module() = default;
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;

  const std::string& name() const noexcept { return name_; }  ///< as printed in findings and in `presa explain`
  RateGroup group() const noexcept { return group_; }         ///< sets its rate and thread
  const std::vector<InPortBase*>& inputs() const noexcept { return inputs_; }     ///< in the order of declaration
  const std::vector<OutPortBase*>& outputs() const noexcept { return outputs_; }  ///< in the order of declaration

  virtual void start() {}  ///< once before the first step, on the group's thread; may allocate; exceptions end the run
  /// One tick: read inputs, write outputs. In the haptic group: no allocation, lock, exception, text or system call.
  virtual void step(const Tick& tick) noexcept = 0;
  virtual void stop() {}                                          ///< once after the last step, on the same thread
  virtual std::vector<std::string> stages() const { return {}; }  ///< stages of a step, in order, for `presa explain`
  virtual std::vector<std::string> notes() const { return {}; }   ///< before and after a run: what it lacks, or lost
  virtual std::vector<LeftOut> leftOut() const { return {}; }     ///< possible effects that the scene does not call for

 private:
  friend class InPortBase;
  friend class OutPortBase;
  std::string name_;
  RateGroup group_;
  std::vector<InPortBase*> inputs_;
  std::vector<OutPortBase*> outputs_;
};

}  // namespace presa
