#pragma once

namespace presa {

/// Exit statuses of Presa's programs.
enum ExitStatus : int {
  kExitOk = 0,
  kExitFault = 1,          ///< the run ended with a fault, or a verification failed
  kExitBadInput = 2,       ///< nothing was run and nothing written
  kExitInterrupted = 130,  ///< Ctrl-C
};

}  // namespace presa
