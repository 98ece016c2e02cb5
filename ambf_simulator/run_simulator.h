// The whole program as a function: command line, launch file, simulation, windows. A program with kinds of objects of
// its own registers them and calls it (docs/where_to_add.md).
#pragma once

namespace ambf::simulator {

// Returns the exit code (docs/cli.md). Once a process, from main().
int run_simulator(int argc, char** argv);

}  // namespace ambf::simulator
