// The Python module presa._presa: a simulation that is stepped, its states as numpy views.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "apps/python/binding/simulation.h"
#include "framework/device/output_stage.h"

namespace py = pybind11;

namespace presa::python {
namespace {

/// A view that Python cannot write through, and that keeps `owner` alive.
template <class T>
py::array readOnly(py::array_t<T> view) {
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

template <class T>
py::array column(const std::vector<T>& values, const py::object& owner) {
  return readOnly(py::array_t<T>({values.size()}, {sizeof(T)}, values.data(), owner));
}

template <std::size_t N>
py::array_t<double> table(const std::vector<std::array<double, N>>& rows, const py::object& owner) {
  const double* first = rows.empty() ? nullptr : rows.front().data();
  return {{rows.size(), N}, {N * sizeof(double), sizeof(double)}, first, owner};
}

py::dict bodyArrays(const Snapshot& snapshot, const py::object& owner) {
  const Snapshot::Bodies& bodies = snapshot.bodies;
  py::dict arrays;
  arrays["position"] = readOnly(table(bodies.position, owner));
  arrays["orientation"] = readOnly(table(bodies.orientation, owner));
  arrays["velocity"] = readOnly(table(bodies.velocity, owner));
  arrays["angular_velocity"] = readOnly(table(bodies.angular_velocity, owner));
  arrays["asleep"] = column(bodies.asleep, owner).attr("view")("bool");
  return arrays;
}

py::dict fingerArrays(const Snapshot& snapshot, const py::object& owner) {
  const Snapshot::Fingers& fingers = snapshot.fingers;
  py::dict arrays;
  arrays["position"] = readOnly(table(fingers.position, owner));
  arrays["velocity"] = readOnly(table(fingers.velocity, owner));
  arrays["proxy"] = readOnly(table(fingers.proxy, owner));
  arrays["force"] = readOnly(table(fingers.force, owner));
  arrays["rendered_force"] = readOnly(table(fingers.rendered_force, owner));
  arrays["depth"] = column(fingers.depth, owner);
  arrays["normal_force"] = column(fingers.normal_force, owner);
  arrays["mode"] = column(fingers.mode, owner);
  arrays["body"] = column(fingers.body, owner);
  return arrays;
}

py::array contactsOf(const Snapshot& snapshot, const py::object& owner) {
  return readOnly(
      py::array_t<ContactRow>({snapshot.contact_count}, {sizeof(ContactRow)}, snapshot.contacts.data(), owner));
}

/// What the device of a finger was kept from, in words; empty: nothing.
std::vector<std::string> statusWords(std::uint32_t status) {
  static constexpr std::pair<OutputStatus, const char*> kWords[] = {
      {kOutputNotFinite, "not finite"}, {kOutputMagnitude, "force limit"},
      {kOutputSlew, "slew limit"},      {kOutputFading, "fading"},
      {kOutputWatchdog, "watchdog"},    {kOutputLost, "lost"},
      {kOutputSpeed, "over-speed"},     {kOutputWarm, "warm"},
      {kOutputOverload, "overload"},    {kOutputDamped, "damped"},
      {kOutputOther, "other finger"},   {kOutputGap, "gap"}};
  std::vector<std::string> words;
  for (const auto& [bit, word] : kWords)
    if ((status & bit) != 0) words.emplace_back(word);
  return words;
}

py::dict objectFigures(const Simulation& simulation) {
  py::dict figures;
  const Scene& scene = simulation.world().scene;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].fixed) continue;
    const ObjectSummary& object = simulation.monitor().objects()[i];
    py::dict one;
    one["grasped"] = object.grasped;
    one["dropped"] = object.dropped;
    one["lost_at"] = object.lost_at >= 0 ? py::object(py::float_(object.lost_at)) : py::none();
    one["lifted"] = object.highest.z() - object.start.z();
    one["peak_speed"] = object.peak_speed;
    figures[scene.bodies[i].name.c_str()] = one;
  }
  return figures;
}

py::dict fingerFigures(const Simulation& simulation) {
  py::dict figures;
  const Scene& scene = simulation.world().scene;
  for (std::size_t f = 0; f < simulation.monitor().fingers().size(); ++f) {
    const FingerSummary& finger = simulation.monitor().fingers()[f];
    py::dict one;
    one["free"] = finger.seconds[0];
    one["stick"] = finger.seconds[1];
    one["slip"] = finger.seconds[2];
    one["max_normal_force"] = finger.max_normal_force;
    one["mean_normal_force"] = finger.mean_normal_force;
    one["slips"] = finger.slip_onsets;
    one["pop_through"] = finger.pop_through;
    figures[scene.devices[f].role.c_str()] = one;
  }
  return figures;
}

py::dict figuresOf(const Simulation& simulation) {
  py::dict figures;
  figures["objects"] = objectFigures(simulation);
  figures["fingers"] = fingerFigures(simulation);
  figures["coverage_lost"] = simulation.monitor().coverageLost();
  figures["energy_created"] = simulation.monitor().energyCreated().sum;
  return figures;
}

/// Other Python threads run meanwhile; Ctrl-C is answered within kPauseTicks.
bool step(Simulation& simulation, std::uint64_t ticks) {
  const py::gil_scoped_release released;
  return simulation.step(ticks, [] {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
}

template <class Named>
std::vector<std::string> namesOf(const std::vector<Named>& all, std::string Named::*name) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.*name);
  return names;
}

std::unique_ptr<Simulation> make(const Setup& setup) {
  const py::gil_scoped_release released;  // a mesh may take seconds
  return std::make_unique<Simulation>(setup);
}

}  // namespace
}  // namespace presa::python

PYBIND11_MODULE(_presa, module) {
  using namespace presa;
  using namespace presa::python;
  module.doc() = "Presa's simulation, stepped by its caller. Use it through the package `presa`.";
  module.attr("version") = PRESA_VERSION;
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError).attr("__doc__") =
      "A scene, rig or file with mistakes: each on a line, with its place, its number and what is allowed.";
  PYBIND11_NUMPY_DTYPE(ContactRow, finger, body, mode, depth, point, normal, force);

  py::class_<Simulation>(module, "Simulation")
      .def(py::init([](std::string scene, std::string text, std::string rig, std::vector<std::string> sets,
                       std::map<std::string, std::array<double, 3>> fingers, std::uint64_t seed, double duration,
                       std::string record, bool overwrite) {
             return make({std::move(scene), std::move(text), std::move(rig), std::move(sets), std::move(fingers), seed,
                          duration, std::move(record), overwrite});
           }),
           py::arg("scene"), py::arg("text"), py::arg("rig"), py::arg("sets"), py::arg("fingers"), py::arg("seed"),
           py::arg("duration"), py::arg("record"), py::arg("overwrite"))
      .def("step", &step, py::arg("ticks"))
      .def("close", &Simulation::close, py::call_guard<py::gil_scoped_release>())
      .def("press", &Simulation::press, py::arg("finger"), py::arg("buttons"))
      .def("bodies", [](const py::object& self) { return bodyArrays(self.cast<Simulation&>().snapshot(), self); })
      .def("fingers", [](const py::object& self) { return fingerArrays(self.cast<Simulation&>().snapshot(), self); })
      .def("contacts", [](const py::object& self) { return contactsOf(self.cast<Simulation&>().snapshot(), self); })
      .def("targets", [](const py::object& self) { return table(self.cast<Simulation&>().targets(), self); })
      .def("figures", &figuresOf)
      .def_property_readonly("time", &Simulation::time)
      .def_property_readonly("tick", &Simulation::tick)
      .def_property_readonly("done", &Simulation::done)
      .def_property_readonly("notes", &Simulation::notes)
      .def_property_readonly("status", [](const Simulation& self) { return statusWords(self.snapshot().status); })
      .def_property_readonly("state_hash", [](const Simulation& self) { return self.monitor().hash(); })
      .def_property_readonly("body_names",
                             [](const Simulation& self) { return namesOf(self.world().scene.bodies, &Body::name); })
      .def_property_readonly(
          "roles", [](const Simulation& self) { return namesOf(self.world().scene.devices, &DeviceRole::role); });
}
