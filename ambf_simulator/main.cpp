// The program ambf_simulator.
#include "run_simulator.h"

int main(int argc, char** argv) { return ambf::simulator::run_simulator(argc, argv); }
