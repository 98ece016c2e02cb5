"""Module of the original client: import Actuator from here or from ambf_client."""

from ambf_client import Actuator

__all__ = ["Actuator"]
