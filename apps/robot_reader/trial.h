#pragma once
#include <functional>
#include <string>

namespace presa::robot {

/// Does `work` in a child process, with limits on memory and processor time, and returns what it says; a sentence of its
/// own if the child crashes or does not finish. MuJoCo crashes on some damaged files. Thread: main.
std::string trial(const std::function<std::string()>& work);

}  // namespace presa::robot
