#include "command_line.h"

#include <algorithm>
#include <boost/program_options.hpp>
#include <cctype>
#include <cmath>
#include <sstream>

#include "picture_options.h"

namespace ambf::simulator {

namespace po = boost::program_options;

namespace {

constexpr int kMaxFrequencyHz = 1'000'000;
constexpr double kMaxSpeedFactor = 1e9;

// A boolean flag takes a value: 1, 0, true, false, yes, no, on, off in any case (`-g false`, `-t1`).
struct Switch {
  bool value = false;
};

void validate(boost::any& out, const std::vector<std::string>& values, Switch*, int) {
  po::validators::check_first_occurrence(out);
  std::string text = po::validators::get_single_string(values);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* yes : {"1", "true", "yes", "on"}) {
    if (text == yes) {
      out = Switch{true};
      return;
    }
  }
  for (const char* no : {"0", "false", "no", "off"}) {
    if (text == no) {
      out = Switch{false};
      return;
    }
  }
  throw po::invalid_option_value(text);
}

po::options_description describe() {
  po::options_description all("AMBF simulator: ambf_simulator [options]\n\nOptions", 110, 60);
  const auto text = [] { return po::value<std::string>(); };
  const auto number = [] { return po::value<int>(); };
  const auto real = [] { return po::value<double>(); };
  const auto flag = [] { return po::value<Switch>(); };
  // No token is taken unseen: what starts with dashes stays a flag.
  const auto files = [] { return po::value<std::vector<std::string>>()->multitoken()->zero_tokens(); };
  po::options_description load("What to load");
  load.add_options()                                                                                                //
      ("launch_file", text(), "launch file (default: the shipped ambf_models/descriptions/launch.yaml)")            //
      ("load_multibodies,l", text(), "comma list of indices into the launch file's models (default 1 without -a)")  //
      ("load_multibody_files,a", text(), "comma list of ADF and URDF files, relative to the working directory")     //
      ("free_base", po::bool_switch(), "of URDF files: the root link moves (default: it is static)")                //
      ("merge_fixed", po::bool_switch(), "of URDF files: links that fixed joints connect become one body")          //
      ("plugins", text(), "simulator plugins, separated by commas");
  po::options_description time("Time");
  time.add_options()                                                                      //
      ("phx_frequency,p", number(), "turns of the physics loop a second (default 1000)")  //
      ("fixed_phx_timestep,t", flag(),
       "fixed steps of speed/frequency, not bound to the wall clock (default false)")                                //
      ("sim_speed_factor,s", real(), "factor on the simulated time of an iteration; only with -t true (default 1)")  //
      ("run_for", real(), "end after so many seconds of wall time and print what was achieved (default: run on)");
  po::options_description physics("Physics");
  physics.add_options()  //
      ("solver", text(),
       "direct (default): joints exact, contacts by sequential impulse; si: sequential impulse; mlcp")  //
      ("solver_iterations", number(), "iterations of the solver (default: 10)")                         //
      ("friction_directions", number(), "1 or 2 (default 2: what is held or rests does not creep)")     //
      ("sleeping", flag(), "undisturbed bodies rest at no cost (default true)");
  po::options_description comm("Communication");
  comm.add_options()  //
      ("release_silent_throttle", flag(),
       "a throttling client that is silent for 0.5 s lets the simulation run on (default false)")  //
      ("legacy_states", text(),
       "publish every State beside as AMBF 1.0 (g2) or 3.0 (g4) does, for programs built against its messages")  //
      ("crtk", text(),
       "comma list of files that describe arms to be offered as those of the CRTK are (docs/crtk.md)")  //
      ("clock", po::bool_switch(),
       "stamp what these arms publish in simulated time, publish that on /clock, and set /use_sim_time")  //
      ("no_ros", po::bool_switch(), "offer no ROS topics and never look for a master")                    //
      ("ns", text(), "prefix of all topics")                                                              //
      ("override_max_comm_freq", real(), "publishing rate of all objects while commanded, Hz")            //
      ("override_min_comm_freq", real(), "publishing rate of all objects while not commanded, Hz");
  po::options_description view("Seeing");
  view.add_options()                                                                                      //
      ("show_gui,g", flag(), "open windows (default true; without a display the program runs headless)")  //
      ("keep_running_without_display", po::bool_switch(),
       "when the display dies, run on headless instead of ending")                                                 //
      ("check_graphics", po::bool_switch(), "let the graphics driver check every call and log its errors (slow)")  //
      ("screenshot", files(),
       "FILE[:CAMERA]...: pictures (.png, .jpg) once the scene has come to rest, then end, unless -g true or --run_for "
       "is given")                                                                                                  //
      ("video", text(), "FILE[:CAMERA]: a video (by ffmpeg; without it numbered PNGs), then end, as --screenshot")  //
      ("fps", number(), "pictures a second of simulation time in the video (default 30)")                           //
      ("seconds", real(), "length of the video (default 10)")                                                       //
      ("at", real(), "simulation time at which pictures are taken or the video begins, s")                          //
      ("picture_size", text(), "WIDTHxHEIGHT (default: what the camera publishes, else 1280x720)")                  //
      ("quality", text(), "draft, normal or fine (default: screenshots fine, videos normal)")                       //
      ("offscreen", text(), "who draws pictures that no window shows: auto (default), osmesa or egl");
  po::options_description devices("Input devices");
  devices.add_options()                                                                                 //
      ("ndevs,n", number(), "number of devices from the input device file (default 0)")                 //
      ("load_devices,i", text(), "comma list of devices, by index or name; overrides -n")               //
      ("enableforces,e", flag(), "force feedback (default false)")                                      //
      ("htx_frequency,d", number(), "haptics loop, Hz (default 1000)")                                  //
      ("fixed_htx_timestep,f", flag(), "fixed haptics time step (default false)")                       //
      ("record_input", text(), "FILE: record all inputs, so that the session can be replayed exactly")  //
      ("replay_input", text(), "FILE: repeat such a session, compare each frame and set-point, and end");
  po::options_description other("Other");
  other.add_options()  //
      ("check", files(),
       "check ADF files, print all findings, exit 0 or 1")                                         //
      ("strict", po::bool_switch(), "with --check: warnings fail, too")                            //
      ("convert", files(), "URDF ADF: write the robot of a URDF file as a new ADF file, and end")  //
      ("limits", po::bool_switch(), "print all bounds and what happens beyond them, and end")(
          "log_file", text(), "write all messages to this file as well")  //
      ("version", po::bool_switch(), "print the version")                 //
      ("help,h", po::bool_switch(), "print this");
  all.add(load).add(time).add(physics).add(comm).add(view).add(devices).add(other);
  return all;
}

std::string spelled(const std::string& name) {
  return name.rfind('-', 0) == 0 ? name : (name.size() == 1 ? "-" : "--") + name;
}

// Splits at commas and trims; empty entries are left out.
std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  std::stringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) {
    const auto first = part.find_first_not_of(" \t");
    if (first == std::string::npos) continue;
    parts.push_back(part.substr(first, part.find_last_not_of(" \t") - first + 1));
  }
  return parts;
}

// Later checks in one place; returns what is wrong or nothing.
void read_values(const po::variables_map& map, CommandLine& o) {
  const auto text = [&](const char* name, std::string& out) {
    if (map.count(name) != 0) out = map[name].as<std::string>();
  };
  const auto number = [&](const char* name, int& out) {
    if (map.count(name) != 0) out = map[name].as<int>();
  };
  const auto real = [&](const char* name, auto& out) {
    if (map.count(name) != 0) out = map[name].as<double>();
  };
  const auto flag = [&](const char* name, bool& out) {
    if (map.count(name) != 0) out = map[name].as<Switch>().value;
  };
  o.help = map["help"].as<bool>();
  o.version = map["version"].as<bool>();
  o.strict = map["strict"].as<bool>();
  o.limits = map["limits"].as<bool>();
  o.no_ros = map["no_ros"].as<bool>();
  o.free_base = map["free_base"].as<bool>();
  o.merge_fixed = map["merge_fixed"].as<bool>();
  o.keep_running_without_display = map["keep_running_without_display"].as<bool>();
  o.check_graphics = map["check_graphics"].as<bool>();
  if (map.count("check") != 0) o.check_files = map["check"].as<std::vector<std::string>>();
  if (map.count("convert") != 0) o.convert_files = map["convert"].as<std::vector<std::string>>();
  text("launch_file", o.launch_file), text("plugins", o.plugins), text("ns", o.ns), text("solver", o.solver);
  text("legacy_states", o.legacy_states);
  text("load_devices", o.device_indices), text("log_file", o.log_file);
  text("record_input", o.record_input), text("replay_input", o.replay_input);
  number("phx_frequency", o.physics_frequency_hz), number("htx_frequency", o.haptics_frequency_hz);
  number("ndevs", o.device_count), number("solver_iterations", o.solver_iterations);
  number("friction_directions", o.friction_directions);
  real("sim_speed_factor", o.speed_factor), real("run_for", o.run_for_seconds);
  real("override_max_comm_freq", o.override_max_comm_hz), real("override_min_comm_freq", o.override_min_comm_hz);
  flag("fixed_phx_timestep", o.fixed_physics_timestep), flag("fixed_htx_timestep", o.fixed_haptics_timestep);
  flag("enableforces", o.enable_forces), flag("show_gui", o.show_gui), flag("sleeping", o.sleeping),
      flag("release_silent_throttle", o.release_silent_throttle);
  o.clock = map["clock"].as<bool>();
  if (map.count("crtk") != 0) o.crtk_files = split(map["crtk"].as<std::string>());
  if (map.count("load_multibody_files") != 0) o.model_files = split(map["load_multibody_files"].as<std::string>());
}

// "-l 1,2": the indices, or what is wrong with them.
std::string read_indices(const std::string& list, std::vector<int>& indices) {
  for (const std::string& part : split(list)) {
    std::size_t used = 0;
    int index = -1;
    try {
      index = std::stoi(part, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used != part.size() || index < 0) {
      return "-l (--load_multibodies) takes a comma list of indices from 0, such as -l 1,2; '" + part + "' is none";
    }
    indices.push_back(index);
  }
  return {};
}

// The option to which file names belong that follow a flag: `--check --strict FILE`, `--screenshot --at 1 a.png`.
const char* option_of_files(const std::vector<std::string>& arguments) {
  for (const char* name : {"check", "screenshot", "convert"}) {
    const std::string flag = std::string("--") + name;
    for (const std::string& argument : arguments)
      if (argument == flag || argument.rfind(flag + "=", 0) == 0) return name;
  }
  return nullptr;
}

// A recording holds all that it was made with.
std::string beside_replay(const po::variables_map& map) {
  if (map.count("replay_input") == 0) return {};
  for (const auto& [name, value] : map) {
    if (!value.defaulted() && name != "replay_input" && name != "log_file" && name != "show_gui" && name != "no_ros")
      return "--replay_input runs as the recording was made; " + spelled(name) + " has no meaning beside it";
  }
  return {};
}

// An option that takes files, without one: nothing would be done, silently.
std::string missing_files(const po::variables_map& map) {
  for (const char* name : {"check", "screenshot"}) {
    if (map.count(name) != 0 && map[name].as<std::vector<std::string>>().empty())
      return std::string("--") + name + " needs a FILE";
  }
  if (map.count("convert") != 0 && map["convert"].as<std::vector<std::string>>().size() != 2)
    return "--convert needs two files: the URDF file to read and the ADF file to write";
  return {};
}

// name:=value, as ROS programs are given remappings, parameters and names.
bool is_ros_argument(const std::string& argument) {
  const auto sign = argument.find(":=");
  return sign != 0 && sign != std::string::npos && argument.front() != '-' && argument.find_first_of(" .,") > sign;
}

}  // namespace

std::string help_text() {
  std::ostringstream out;
  out << describe();
  return out.str();
}

std::string check_values(const CommandLine& o) {
  if (o.physics_frequency_hz < 1 || o.physics_frequency_hz > kMaxFrequencyHz) {
    return "-p (--phx_frequency) must be between 1 and 1000000 Hz, not " + std::to_string(o.physics_frequency_hz);
  }
  if (o.haptics_frequency_hz < 1 || o.haptics_frequency_hz > kMaxFrequencyHz) {
    return "-d (--htx_frequency) must be between 1 and 1000000 Hz, not " + std::to_string(o.haptics_frequency_hz);
  }
  if (!std::isfinite(o.speed_factor) || o.speed_factor <= 0.0 || o.speed_factor > kMaxSpeedFactor) {
    return "-s (--sim_speed_factor) must be above 0 and at most 1e9";
  }
  if (!std::isfinite(o.run_for_seconds) || o.run_for_seconds < 0.0) return "--run_for must not be negative";
  if (o.device_count < 0) return "-n (--ndevs) must not be negative";
  if (!o.solver.empty() && o.solver != "direct" && o.solver != "si" && o.solver != "mlcp") {
    return "--solver must be direct, si or mlcp, not '" + o.solver + "'" +
           (o.solver == "nncg" ? " (nncg diverges with every mechanism tried and is not offered)" : "");
  }
  if (!o.legacy_states.empty() && o.legacy_states != "g2" && o.legacy_states != "g4") {
    return "--legacy_states must be g2 or g4 (the messages of AMBF 1.0 or 3.0), not '" + o.legacy_states + "'";
  }
  if (o.solver_iterations < 0 || o.solver_iterations > 10000) return "--solver_iterations must be between 0 and 10000";
  if (o.friction_directions != 1 && o.friction_directions != 2) return "--friction_directions must be 1 or 2";
  for (const auto& [name, rate] : {std::pair{"--override_max_comm_freq", o.override_max_comm_hz},
                                   std::pair{"--override_min_comm_freq", o.override_min_comm_hz}}) {
    if (rate && (!std::isfinite(*rate) || *rate <= 0.0 || *rate > kMaxFrequencyHz)) {
      return std::string(name) + " must be above 0 and at most 1000000 Hz";
    }
  }
  if (o.override_max_comm_hz && o.override_min_comm_hz && *o.override_max_comm_hz < *o.override_min_comm_hz) {
    return "--override_max_comm_freq must not be below --override_min_comm_freq";
  }
  if (o.strict && o.check_files.empty()) return "--strict is only meant with --check FILE...";
  return {};
}

ParsedCommandLine parse_command_line(int argc, const char* const* argv) {
  CommandLine options;
  // Dashes within our own flags may be written instead of underscores: --no-ros is --no_ros.
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    std::string argument = argv[i];
    if (is_ros_argument(argument)) {
      // roslaunch gives every program the first two: they ask nothing of us.
      if (argument.rfind("__name:=", 0) != 0 && argument.rfind("__log:=", 0) != 0)
        options.ros_arguments.push_back(std::move(argument));
      continue;
    }
    if (argument.rfind("--", 0) == 0) {
      const auto end = std::min(argument.find('='), argument.size());
      std::replace(argument.begin() + 2, argument.begin() + static_cast<std::ptrdiff_t>(end), '-', '_');
    }
    arguments.push_back(std::move(argument));
  }
  try {
    po::variables_map map;
    namespace style = po::command_line_style;
    const po::options_description all = describe();
    po::positional_options_description rest;
    if (const char* option = option_of_files(arguments)) rest.add(option, -1);
    po::store(po::command_line_parser(arguments)
                  .options(all)
                  .positional(rest)
                  .style(style::unix_style & ~style::allow_guessing)
                  .run(),
              map);
    po::notify(map);
    if (std::string wrong = missing_files(map); !wrong.empty()) return {std::nullopt, wrong};
    if (std::string wrong = beside_replay(map); !wrong.empty()) return {std::nullopt, wrong};
    read_values(map, options);
    if (std::string wrong = read_picture_options(map, options); !wrong.empty()) return {std::nullopt, wrong};
    if (map.count("load_multibodies") != 0) {
      if (std::string wrong = read_indices(map["load_multibodies"].as<std::string>(), options.model_indices);
          !wrong.empty()) {
        return {std::nullopt, wrong};
      }
    } else if (map.count("load_multibody_files") == 0) {
      options.model_indices = {1};
    }
  } catch (const po::unknown_option& e) {
    return {std::nullopt, "unknown option " + spelled(e.get_option_name())};
  } catch (const po::too_many_positional_options_error&) {
    return {std::nullopt, "every argument belongs to an option; ADF files are given with -a FILE[,FILE...]"};
  } catch (const po::error& e) {
    return {std::nullopt, e.what()};
  }
  if (std::string wrong = check_values(options); !wrong.empty()) return {std::nullopt, wrong};
  return {options, {}};
}

}  // namespace ambf::simulator
