#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/graph/graph.h"

namespace presa {

/// Collects modules and connections, validates them, and freezes them into a Graph. Single use.
class GraphBuilder {
 public:
  /// Takes the module; returns it for connecting.
  template <class M>
  M& add(std::unique_ptr<M> module) {
    M& reference = *module;
    modules_.push_back(std::move(module));
    return reference;
  }

  /// Connects one output to one input; their types must be the same.
  void connect(OutPortBase& from, InPortBase& to);
  /// Connects every input that is still open to the one output of the same port name and type.
  void connectByName();

  /// Throws InputError with every finding (E5xx): duplicate module name, unconnected required input,
  /// type mismatch, two writers for one name, two values of one name read across rates by one group, loop within a rate
  /// group (printed port by port).
  Graph build();

 private:
  struct Link {
    OutPortBase* from;
    InPortBase* to;
  };
  void checkNames();
  void checkInputs();
  std::vector<Module*> order(RateGroup group);

  std::vector<std::unique_ptr<Module>> modules_;
  std::vector<Link> links_;
  Diagnostics diagnostics_;
};

}  // namespace presa
