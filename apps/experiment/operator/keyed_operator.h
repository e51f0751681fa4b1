#pragma once
#include <memory>

#include "apps/common/terminal/interruption.h"
#include "apps/experiment/operator/console_view.h"
#include "apps/experiment/operator/operator.h"

namespace presa::experiment {

/// Display and keyboard of an operator: a terminal or a window. Thread: main.
class Face {
 public:
  virtual ~Face() = default;
  virtual void draw(const ConsoleView& console_view) = 0;
  /// The next key within `ms` milliseconds; 0: no key.
  virtual char key(int ms) = 0;
  virtual std::size_t columns() const = 0;
  virtual std::size_t rows() const = 0;
  /// True when the display is closed for good; no operator is left then.
  virtual bool closed() const { return false; }

 private:
  terminal::Interruption interruption_;  // Ctrl-C is heard before a terminal changes and until it is back
};

/// An operator who reads the console and answers with keys.
std::unique_ptr<Operator> keyedOperator(std::unique_ptr<Face> face);

}  // namespace presa::experiment
