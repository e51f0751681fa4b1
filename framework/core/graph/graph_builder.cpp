#include "framework/core/graph/graph_builder.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace presa {
namespace {

const SourceLocation kGraph{"graph", 0, 0};

std::string path(const InPortBase& port) { return port.owner().name() + "." + port.name(); }
std::string path(const OutPortBase& port) { return port.owner().name() + "." + port.name(); }

}  // namespace

void GraphBuilder::connect(OutPortBase& from, InPortBase& to) {
  if (from.type() != to.type()) {
    diagnostics_.error(502, kGraph, path(from) + " and " + path(to) + " carry different types",
                       "connect ports of one type; their names usually agree");
    return;
  }
  if (to.connected_) {
    diagnostics_.error(503, kGraph, path(to) + " is connected twice, now to " + path(from),
                       "an input has one writer; merge the two values in a module of their own");
    return;
  }
  to.connected_ = true;
  links_.push_back({&from, &to});
}

void GraphBuilder::connectByName() {
  for (const auto& reader : modules_) {
    for (InPortBase* input : reader->inputs()) {
      if (input->connected()) continue;
      OutPortBase* found = nullptr;
      for (const auto& writer : modules_) {
        for (OutPortBase* output : writer->outputs()) {
          if (output->name() != input->name()) continue;
          if (found != nullptr) {
            diagnostics_.error(504, kGraph,
                               "two modules write '" + input->name() + "': " + path(*found) + " and " + path(*output),
                               "connect " + path(*input) + " to one of them by hand, or rename a port");
          }
          found = output;
        }
      }
      if (found != nullptr) connect(*found, *input);
    }
  }
}

void GraphBuilder::checkNames() {
  std::set<std::string> names;
  for (const auto& module : modules_) {
    if (!names.insert(module->name()).second) {
      diagnostics_.error(505, kGraph, "two modules are named '" + module->name() + "'", "give each its own name");
    }
  }
}

void GraphBuilder::checkInputs() {
  std::vector<std::string> outputs;
  for (const auto& module : modules_) {
    for (const OutPortBase* output : module->outputs()) outputs.push_back(output->name());
  }
  for (const auto& module : modules_) {
    for (const InPortBase* input : module->inputs()) {
      if (input->connected() || input->optional()) continue;
      diagnostics_.error(501, kGraph, "nothing is connected to " + path(*input),
                         "add the module that writes '" + input->name() + "'" + didYouMean(input->name(), outputs));
    }
  }
}

void GraphBuilder::checkInput(const std::vector<std::string>& others, RateGroup group, const std::string& name) {
  const std::string reads = std::string("the ") + toString(group) + " group reads ";
  if (isScheduled(group) && std::find(others.begin(), others.end(), name) != others.end()) {
    diagnostics_.error(508, kGraph, reads + "two values named '" + name + "' across rates",
                       "rename a port: recordings tell values apart by name");
  }
  if (others.size() == ScheduleRow::kMaxBridges) {
    diagnostics_.error(507, kGraph, reads + "more than " + std::to_string(others.size()) + " values across rates");
  }
}

// Kahn's algorithm; ready modules are taken in the order in which they were added, so that the step
// order is the same in every run.
std::vector<Module*> GraphBuilder::order(RateGroup group) {
  std::vector<Module*> open;
  for (const auto& module : modules_) {
    if (module->group() == group) open.push_back(module.get());
  }
  std::vector<Module*> done;
  const auto waits_for = [&](const Module* module) -> const Link* {
    for (const Link& link : links_) {
      if (&link.to->owner() != module || link.from->owner().group() != group || link.to->ofLastTick()) continue;
      if (std::find(done.begin(), done.end(), &link.from->owner()) == done.end()) return &link;
    }
    return nullptr;
  };
  while (!open.empty()) {
    const auto ready = std::find_if(open.begin(), open.end(), [&](const Module* m) { return waits_for(m) == nullptr; });
    if (ready == open.end()) {
      // every remaining module waits for another one: follow the links backwards into the loop, then once around it
      const Module* at = open.front();
      for (std::size_t i = 0; i < open.size(); ++i) at = &waits_for(at)->from->owner();
      const Module* const begin = at;
      std::string loop;
      do {
        const Link& link = *waits_for(at);
        loop = path(*link.from) + " -> " + path(*link.to) + "; " + loop;
        at = &link.from->owner();
      } while (at != begin);
      diagnostics_.error(506, kGraph, std::string("the ") + toString(group) + " group has a loop: " + loop,
                         "one of these must read the value of the tick before: give it state, or another rate");
      return {};
    }
    done.push_back(*ready);
    open.erase(ready);
  }
  return done;
}

Graph GraphBuilder::build() {
  checkNames();
  checkInputs();
  Graph graph;
  for (int g = 0; g < kRateGroupCount; ++g) {
    auto& group = graph.groups_[static_cast<std::size_t>(g)];
    group.modules = order(static_cast<RateGroup>(g));
    group.outputs.resize(group.modules.size());
  }
  // sorted by name: recordings of format 6 and older do not name their columns and rely on this order
  std::stable_sort(links_.begin(), links_.end(),
                   [](const Link& a, const Link& b) { return a.to->name() < b.to->name(); });
  std::map<const OutPortBase*, BridgeBase*> bridges;
  for (const Link& link : links_) {
    Graph::Group &from = graph.groupOf(link.from->owner().group()), &to = graph.groupOf(link.to->owner().group());
    if (&from == &to) {
      link.from->connectDirect(*link.to);
      graph.connections_.push_back({link.from, link.to, nullptr});
      continue;
    }
    BridgeBase*& bridge = bridges[link.from];
    if (bridge == nullptr) {
      graph.bridges_.push_back(link.from->makeBridge());
      bridge = graph.bridges_.back().get();
      for (std::size_t i = 0; i < from.modules.size(); ++i) {
        if (from.modules[i] == &link.from->owner()) from.outputs[i].push_back(bridge);
      }
    }
    if (std::find(to.inputs.begin(), to.inputs.end(), bridge) == to.inputs.end()) {
      checkInput(to.input_names, link.to->owner().group(), link.to->name());
      to.inputs.push_back(bridge);
      to.input_names.push_back(link.to->name());
    }
    bridge->addReader(*link.to);
    graph.connections_.push_back({link.from, link.to, bridge});
  }
  if (diagnostics_.hasErrors()) throw InputError(diagnostics_);
  graph.modules_ = std::move(modules_);
  return graph;
}

}  // namespace presa
