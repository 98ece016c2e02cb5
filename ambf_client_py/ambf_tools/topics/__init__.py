"""Topics and services of any type: listed, watched, published, called; for ambf-cli and the simulator's panel."""
