#pragma once

namespace presa {

/// Requests of the program to the module that assembles bodies. Thread: any.
class AssemblyControl {
 public:
  virtual ~AssemblyControl() = default;
  /// Removes the body that was placed last, at the module's next step.
  virtual void undo() noexcept = 0;
};

}  // namespace presa
