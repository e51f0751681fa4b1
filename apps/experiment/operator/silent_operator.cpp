#include "apps/common/terminal/job_progress.h"
#include "apps/experiment/operator/operator.h"

namespace presa::experiment {
namespace {

class SilentOperator final : public Operator {
 public:
  explicit SilentOperator(std::size_t jobs) : progress_(jobs), left_(jobs) {}

  void show(const SessionView& view) override {
    if (view.left > left_) progress_.more(view.left - left_);  // a trial is repeated
    left_ = view.left;
    if (view.seconds_left >= 0) progress_.expect(view.seconds_left);
    progress_.show();
  }
  Request request() override { return terminal::JobProgress::interrupted() ? Request::kStop : Request::kNone; }
  Request await(const std::string&, double) override { return request(); }
  std::optional<int> ask(const std::string&) override { return std::nullopt; }
  std::optional<psychophysics::AdjustmentKey> askAdjust(const std::string&) override { return std::nullopt; }
  void ended(const std::string& what) override {
    if (left_ > 0) --left_;
    progress_.done(what);
  }
  bool silent() const override { return true; }

 private:
  terminal::JobProgress progress_;
  std::size_t left_;
};

}  // namespace

std::unique_ptr<Operator> silentOperator(std::size_t jobs) { return std::make_unique<SilentOperator>(jobs); }

}  // namespace presa::experiment
