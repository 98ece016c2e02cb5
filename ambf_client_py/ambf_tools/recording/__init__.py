"""The recording process: what is behind ambf_tools.record. Nothing here is meant to be imported by users."""
