// The simulator, knowing one more kind of object: the files linked with it register it before main() begins.
#include "run_simulator.h"

int main(int argc, char** argv) { return ambf::simulator::run_simulator(argc, argv); }
