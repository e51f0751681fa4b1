#pragma once
#include <memory>
#include <vector>

#include "framework/assembly/goal_pulls.h"
#include "framework/core/graph/port.h"
#include "framework/scene/guide_orders.h"
#include "framework/scene/world.h"

namespace presa::assembly {

/// The assembly of a run whose guide is in a viewer: pulls what the guide orders, where that is possible, and nothing
/// else. An order has an effect only for a body within reach of its goal, in its turn, and the pull begins at zero: no
/// order, however wrong or late, makes a step in force. A pull that has begun ends as one that the run chose itself:
/// with the body in place, or out of reach; also when the guide falls silent. In ports: object_state, guide_orders.
/// Out:
/// attractions, assembly_state, taken_orders. Thread: collision.
class OrderedAssembly final : public Module {
 public:
  explicit OrderedAssembly(std::shared_ptr<const World> world);
  void step(const Tick& tick) noexcept override;
  std::vector<std::string> stages() const override;

 private:
  /// What became of the order for one goal.
  struct Draw {
    GuideOrders::Draw ordered;
    bool pulls = false;
    bool over = false;  // it has ended, or could not begin: only a new order pulls again
  };
  void takeOrders(std::uint64_t tick);
  void choose(const ObjectState& objects);
  bool mayPull(std::size_t goal, const ObjectState& objects) const;

  In<ObjectState> objects_{*this, "object_state"};
  In<GuideOrders> orders_{*this, kGuideOrdersPort, In<GuideOrders>::Optional{}};
  Out<SnapConstraints> snap_constraints_{*this, "attractions"};
  Out<AssemblyState> state_{*this, "assembly_state"};
  Out<TakenOrders> taken_{*this, kTakenOrdersPort};
  std::shared_ptr<const World> world_;
  const Assembly& assembly_;
  GoalPulls pulls_;
  std::vector<Draw> draws_;        // by goal
  std::vector<GoalState> chosen_;  // by goal
  std::vector<char> busy_;         // by body: pulled to a goal, or in place
  std::int32_t undone_ = 0;
};

}  // namespace presa::assembly
