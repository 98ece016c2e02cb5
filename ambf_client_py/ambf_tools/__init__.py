"""Programs on top of AMBF: ambf-cli, control panels, the recorder, and what reads its bags."""
