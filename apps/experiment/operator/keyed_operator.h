#pragma once
#include <memory>

#include "apps/common/terminal/interruption.h"
#include "apps/experiment/operator/board.h"
#include "apps/experiment/operator/operator.h"

namespace presa::experiment {

/// Where an operator reads and types: a terminal or a window. Thread: main.
class Face {
 public:
  virtual ~Face() = default;
  virtual void draw(const Board& board) = 0;
  /// The next key within `ms`; 0: none.
  virtual char key(int ms) = 0;
  virtual std::size_t columns() const = 0;
  virtual std::size_t rows() const = 0;
  /// It is gone for good, and with it the operator.
  virtual bool closed() const { return false; }

 private:
  terminal::Interruption interruption_;  // Ctrl-C is heard before a terminal changes and until it is back
};

/// An operator who sees the board and answers with keys.
std::unique_ptr<Operator> keyedOperator(std::unique_ptr<Face> face);

}  // namespace presa::experiment
