"""Module of the original client: import AmbfEnv from here or from ambf_client."""

from ambf_client import AmbfEnv, Observation

__all__ = ["AmbfEnv", "Observation"]
