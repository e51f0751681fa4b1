#pragma once

namespace presa {

/// Call first in main. Opens descriptors 0, 1 and 2 on the null device if they are closed, so that no other file gets
/// one of these numbers and receives terminal output. Writing to an output that was closed fails: see outputLost().
/// Exceeding the file size limit becomes an error of write() instead of ending the process.
void openStandardStreams();

/// Call last in main. Whether some standard output was lost (disk full, closed); if so, reports it on standard error.
bool outputLost();

}  // namespace presa
