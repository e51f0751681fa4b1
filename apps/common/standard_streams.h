#pragma once

namespace presa {

/// First of all in main: descriptors 0, 1 and 2 that came closed are opened on the null device, so that no file of the program gets
/// one of these numbers and takes what is meant for a terminal. Output that came closed takes nothing: see outputLost(). A full file
/// size limit becomes an error of write() instead of the end.
void openStandardStreams();

/// Last of all: whether something that was written to standard output was lost (disk full, closed); says so on standard error.
bool outputLost();

}  // namespace presa
