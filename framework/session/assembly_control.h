#pragma once

namespace presa {

/// What the program asks of the module that puts bodies together. Thread: any.
class AssemblyControl {
 public:
  virtual ~AssemblyControl() = default;
  /// Takes out the body that was put last, at the module's next step.
  virtual void undo() noexcept = 0;
};

}  // namespace presa
