// The Python module _ambf_core: SteppedWorld for the package ambf_core, which documents it. Refuses calls that would
// break a world: after close(), from a second thread while one is inside, in a forked process.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>
#include <stdexcept>

#include "arm_module.h"
#include "doorbell.h"
#include "frame_capsule.h"
#include "state/actuators.h"
#include "state/sensors.h"
#include "stepped_world.h"
#include "task_module.h"

namespace nb = nanobind;

namespace ambf::python {
namespace {

using Arrays = std::vector<nb::ndarray<nb::device::cpu, nb::c_contig>>;
// success, message, findings, name
using Answer = std::tuple<bool, std::string, std::vector<std::string>, std::string>;

constexpr unsigned kStepsBetweenSignals = 1000;  // Ctrl-C is seen after so many

constexpr int kPooledPairs = 128;  // worlds are many, and no other thread waits for this one: memory counts
std::atomic<unsigned> forks{0};

std::vector<std::string> texts(const base::Diagnostics& diagnostics) {
  std::vector<std::string> out;
  for (const base::Diagnostic& each : diagnostics) out.push_back(base::to_string(each));
  return out;
}

Answer answer(const state::Outcome& outcome) {
  return {outcome.success, outcome.message, texts(outcome.diagnostics), outcome.model};
}

class PythonWorld {
 public:
  explicit PythonWorld(const WorldSettings& settings) : forks_(forks.load()) {
    const nb::gil_scoped_release release;
    world_ = std::make_unique<SteppedWorld>(settings);
  }
  ~PythonWorld() {
    if (forks_ != forks.load()) (void)world_.release();  // its locks may be held by threads that are not here
  }
  PythonWorld(const PythonWorld&) = delete;
  PythonWorld& operator=(const PythonWorld&) = delete;

  // What runs inside has the world for itself, without the GIL.
  template <class Work>
  auto with_world(Work&& work) {
    const Inside inside(*this);
    const nb::gil_scoped_release release;
    return work(*world_);
  }

  void close() {
    if (world_ == nullptr) return;
    const Inside inside(*this);
    const nb::gil_scoped_release release;
    world_.reset();
  }

  void attach(Arrays state, Arrays commands, bool keep_commands) {
    with_world([&](SteppedWorld& world) {
      world.attach(memory(*world.structure(), state, state_fields()),
                   memory(*world.structure(), commands, command_fields()), keep_commands);
    });
    state_ = std::move(state);
    commands_ = std::move(commands);
  }

  nb::object with_frame(const nb::callable& look) {  // which must not keep it
    const Inside inside(*this);
    return look(capsule_of(world_->frame()));
  }

  // The first of `count` worlds of this structure whose commands, one world behind the other in each array, are not
  // fit to act on, and why; count: none.
  std::tuple<std::size_t, std::string> check(const Arrays& commands, std::size_t count) {
    return with_world([&](SteppedWorld& world) -> std::tuple<std::size_t, std::string> {
      Memory each = memory(*world.structure(), commands, command_fields(), count);
      for (std::size_t i = 0; i < count; ++i) {
        std::string problem = world.check(each);
        if (!problem.empty()) return {i, problem};
        for (std::size_t field = 0; field < each.size(); ++field) {
          each[field] = static_cast<char*>(each[field]) + bytes_of(*world.structure(), command_fields()[field]);
        }
      }
      return {count, {}};
    });
  }

  // Whether the world is good and has logged nothing.
  bool step(long long n) {
    if (n < 0) throw nb::value_error(("step: " + std::to_string(n) + " steps").c_str());
    const Inside inside(*this);
    bool good = true;
    std::string problem;
    {
      const nb::gil_scoped_release release;
      problem = world_->post();
      if (problem.empty()) good = world_->run(static_cast<unsigned>(std::min<long long>(n, kStepsBetweenSignals)));
    }
    if (!problem.empty()) throw nb::value_error(problem.c_str());
    while (good && (n -= kStepsBetweenSignals) > 0) {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
      const nb::gil_scoped_release release;
      good = world_->run(static_cast<unsigned>(std::min<long long>(n, kStepsBetweenSignals)));
    }
    return good && !world_->has_log();
  }

 private:
  class Inside {
   public:
    explicit Inside(PythonWorld& of) : of_(of) {
      if (of.forks_ != forks.load()) throw std::runtime_error("the world belongs to the process that forked this one");
      if (of.busy_.exchange(true)) throw std::runtime_error("another thread is using this world");
      if (of.world_ != nullptr) return;
      of.busy_ = false;
      throw std::runtime_error("the world is closed");
    }
    ~Inside() { of_.busy_ = false; }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

   private:
    PythonWorld& of_;
  };

  static Memory memory(const state::Structure& structure, const Arrays& arrays, std::span<const Field> fields,
                       std::size_t worlds = 1) {
    Memory out;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (arrays.size() != fields.size() || arrays[i].nbytes() != worlds * bytes_of(structure, fields[i])) {
        throw std::invalid_argument(std::string("array ") + fields[i].name + " does not fit the world");
      }
      out.push_back(arrays[i].data());
    }
    return out;
  }

  std::unique_ptr<SteppedWorld> world_;
  Arrays state_, commands_;  // keep their memory
  std::atomic<bool> busy_{false};
  const unsigned forks_;
};

// One cache for all worlds of this process; a forked one begins anew, as the lock may be held by a thread it lacks.
std::shared_ptr<mesh::MeshCache> shared_meshes() {
  static std::shared_ptr<mesh::MeshCache> meshes;
  static unsigned made_after_forks = 0;
  if (meshes == nullptr || made_after_forks != forks.load()) {
    meshes = std::make_shared<mesh::MeshCache>();
    made_after_forks = forks.load();
  }
  return meshes;
}

void make_world(PythonWorld* at, const std::string& world_file, const std::string& colors_file, double step_s,
                const std::string& solver, unsigned iterations, int friction_directions, bool sleeping,
                const std::string& prefix) {
  WorldSettings settings;
  settings.world_file = world_file;
  settings.colors_file = colors_file;
  settings.options.physics_rate_hz = 1.0 / step_s;
  settings.options.solver = solver == "direct" ? runtime::Solver::direct
                            : solver == "si"   ? runtime::Solver::sequential_impulse
                                               : runtime::Solver::mlcp;
  settings.options.solver_iterations = iterations;
  settings.options.friction_directions = friction_directions;
  settings.options.sleeping = sleeping;
  settings.options.name_prefix = prefix;
  settings.options.pooled_pairs = kPooledPairs;
  settings.meshes = shared_meshes();
  new (at) PythonWorld(settings);
}

Answer load(PythonWorld& world, const std::string& path, const std::string& text, const std::string& prefix,
            const std::array<double, 7>& pose) {
  state::LoadRequest request;
  request.path = path;
  request.text = text;
  request.name_prefix = prefix;
  request.T_world_model = {{pose[0], pose[1], pose[2]}, {pose[3], pose[4], pose[5], pose[6]}};
  return world.with_world([&](SteppedWorld& in) { return answer(in.load(request)); });
}

template <state::Outcome (SteppedWorld::*method)(const std::string&)>
Answer by_name(PythonWorld& world, const std::string& name) {
  return world.with_world([&](SteppedWorld& in) { return answer((in.*method)(name)); });
}

state::Parameter parameter_named(const std::string& name) {
  for (int i = 0; i < state::kParameterCount; ++i) {
    const auto parameter = static_cast<state::Parameter>(i);
    if (name == state::info_of(parameter).name) return parameter;
  }
  throw nb::value_error(("there is no parameter '" + name + "'").c_str());
}

Answer set_parameter(PythonWorld& world, const std::string& object, const std::string& name,
                     const std::array<double, 3>& value) {
  const state::Parameter parameter = parameter_named(name);
  return world.with_world([&](SteppedWorld& in) {
    return answer(in.set_parameter(object, parameter, {value[0], value[1], value[2]}));
  });
}

std::array<double, 3> parameter(PythonWorld& world, const std::string& object, const std::string& name) {
  const state::Parameter of = parameter_named(name);
  math::Vec3 value;
  if (!world.with_world([&](SteppedWorld& in) { return in.parameter(object, of, value); })) {
    throw nb::value_error(("no object with '" + name + "', or more than one, is called '" + object + "'").c_str());
  }
  return {value.x, value.y, value.z};
}

// (name, per axis, smallest, greatest)
std::vector<std::tuple<std::string, bool, double, double>> parameters() {
  std::vector<std::tuple<std::string, bool, double, double>> out;
  for (int i = 0; i < state::kParameterCount; ++i) {
    const state::ParameterInfo& info = state::info_of(static_cast<state::Parameter>(i));
    out.emplace_back(info.name, info.per_axis, info.min, info.max);
  }
  return out;
}

nb::dict structure(PythonWorld& python_world) {
  const auto of = python_world.with_world([](SteppedWorld& world) { return world.structure(); });
  nb::list bodies, joints, limits, models, masses, sensors, elements, actuators, cameras, commanded;
  for (const state::BodyInfo& body : of->bodies) {
    bodies.append(of->objects[body.object].name);
    masses.append(body.mass);
  }
  for (const state::JointInfo& joint : of->joints) {
    joints.append(of->objects[joint.object].name);
    const double free = std::numeric_limits<double>::infinity();
    limits.append(nb::make_tuple(joint.has_limits ? joint.lower : -free, joint.has_limits ? joint.upper : free));
  }
  for (const state::SensorInfo& sensor : state::sensors(*of)) {
    sensors.append(of->objects[sensor.object].name);
    elements.append(nb::make_tuple(sensor.first_element, sensor.elements));
  }
  for (const state::ActuatorInfo& actuator : state::actuators(*of)) actuators.append(of->objects[actuator.object].name);
  for (const state::CameraInfo& camera : of->cameras) cameras.append(of->objects[camera.object].name);
  for (const state::ModelInfo& model : of->models) models.append(model.name);
  nb::dict out;
  out["version"] = of->version;
  out["bodies"] = bodies;
  out["joints"] = joints;
  out["limits"] = limits;
  out["masses"] = masses;
  out["models"] = models;
  out["sensors"] = sensors;
  out["elements"] = elements;
  out["actuators"] = actuators;
  out["punctures"] = rows_of(*of, Rows::punctures);
  out["cameras"] = cameras;
  out["tasks"] = names_of_tasks(*of);
  std::vector<bool> listed(of->joints.size());  // all but passive joints
  for (const state::BodyInfo& body : of->bodies) {
    for (const std::uint32_t joint : body.joints) listed[joint] = true;
  }
  for (const bool each : listed) commanded.append(each);
  out["commanded"] = commanded;
  return out;
}

// The field table: (name, rows, columns, numpy's name of the type)
nb::list table(std::span<const Field> fields) {
  constexpr const char* kElements[] = {"f8", "i8", "i4", "i1", "?"};
  nb::list out;
  for (const Field& field : fields)
    out.append(
        nb::make_tuple(field.name, name_of(field.rows), field.columns, kElements[static_cast<int>(field.element)]));
  return out;
}

std::vector<std::tuple<int, std::string>> take_log(PythonWorld& world) {
  std::vector<std::tuple<int, std::string>> out;
  for (const base::LogLine& line : world.with_world([](SteppedWorld& in) { return in.take_log(); })) {
    out.emplace_back(static_cast<int>(line.severity), line.text);
  }
  return out;
}

nb::list names_of_frozen(PythonWorld& world) {
  nb::list out;
  for (const std::string& name : world.with_world([](SteppedWorld& in) { return in.frozen(); })) out.append(name);
  return out;
}

}  // namespace
}  // namespace ambf::python

NB_MODULE(_ambf_core, m) {
  using namespace ambf::python;
  pthread_atfork(nullptr, nullptr, [] { ++forks; });
  nb::exception<RefusedError>(m, "Refused", PyExc_ValueError);
  m.attr("STATE_FIELDS") = table(state_fields());
  m.attr("COMMAND_FIELDS") = table(command_fields());
  m.attr("MAX_CONTACTS") = ambf::base::kMaxContactsInFrame;
  m.def("parameters", &parameters);
  m.def("ring", [](nb::ndarray<std::uint32_t, nb::c_contig> bells, std::size_t i) { ring(bells.data()[i]); });
  m.def("wait_for_ring",
        [](nb::ndarray<std::uint32_t, nb::c_contig> bells, std::size_t i, std::uint32_t seen, double timeout_s) {
          const nb::gil_scoped_release release;
          return wait_for_ring(bells.data()[i], seen, timeout_s);
        });
  bind_arms(m);
  nb::class_<PythonWorld>(m, "World")
      .def("__init__", &make_world)
      .def("close", &PythonWorld::close)
      .def("load", &load)
      .def("unload", &by_name<&SteppedWorld::unload>)
      .def("remove", &by_name<&SteppedWorld::remove>)
      .def("snapshot", &by_name<&SteppedWorld::snapshot>)
      .def("restore", &by_name<&SteppedWorld::restore>)
      .def("forget", &by_name<&SteppedWorld::forget>)
      .def("set_parameter", &set_parameter)
      .def("parameter", &parameter)
      .def("set_gravity",
           [](PythonWorld& world, const std::array<double, 3>& g) {
             world.with_world([&](SteppedWorld& in) { in.set_gravity({g[0], g[1], g[2]}); });
           })
      .def("structure", &structure)
      .def("attach", &PythonWorld::attach)
      .def("with_frame", &PythonWorld::with_frame)
      .def("check", &PythonWorld::check)
      .def("step", &PythonWorld::step)
      .def("reset", [](PythonWorld& world) { world.with_world([](SteppedWorld& in) { in.reset(); }); })
      .def("hash", [](PythonWorld& world) { return world.with_world([](SteppedWorld& in) { return in.hash(); }); })
      .def("frozen", &names_of_frozen)
      .def("take_log", &take_log);
}
