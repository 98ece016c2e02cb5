"""ambf-cli: the simulator from the command line. See docs/tools.md."""
