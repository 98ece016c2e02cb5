"""Topics and services of any type: listed, published, called; for ambf-cli."""
