"""Module of the original client: import Sensor from here or from ambf_client."""

from ambf_client import Sensor

__all__ = ["Sensor"]
