#include "apps/common/terminal/load_progress.h"

namespace presa::terminal {

bool LoadProgress::tell(const std::string& what, double share) {
  if (!progress_) {
    progress_.emplace(kPercent);
    told_ = 0;
  }
  for (; told_ < static_cast<std::size_t>(share * kPercent); ++told_) progress_->done(what);
  progress_->show();
  const bool interrupted = JobProgress::interrupted();
  if (interrupted || share >= 1) progress_.reset();
  return !interrupted;
}

}  // namespace presa::terminal
