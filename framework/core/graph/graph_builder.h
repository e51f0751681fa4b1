#pragma once
#include <memory>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/core/graph/graph.h"

namespace presa {

/// Collects modules and connections, validates them, and freezes them into a Graph. Single use; main thread.
class GraphBuilder {
 public:
  /// Takes the module; returns it for connecting.
  template <class M>
  M& add(std::unique_ptr<M> module) {
    M& reference = *module;
    modules_.push_back(std::move(module));
    return reference;
  }

  /// Connects an output to an input. E502 (other type) and E503 (already connected) are thrown by build().
  void connect(OutPortBase& from, InPortBase& to);
  /// Connects every input that is still open to the output of the same name (E504 when several have it).
  void connectByName();

  /// Throws InputError with every finding: unconnected required input (E501), type mismatch, input with two writers,
  /// ambiguous name, duplicate module name (E505), loop within a rate group (E506, printed port by port), a group that
  /// reads too many values across rates (E507) or two of the same name (E508).
  Graph build();

 private:
  struct Link {
    OutPortBase* from;
    InPortBase* to;
  };
  void checkNames();
  void checkInputs();
  void checkInput(const std::vector<std::string>& others, RateGroup group, const std::string& name);
  std::vector<Module*> order(RateGroup group);

  std::vector<std::unique_ptr<Module>> modules_;
  std::vector<Link> links_;
  Diagnostics diagnostics_;
};

}  // namespace presa
