"""Module of the original client: import Light from here or from ambf_client."""

from ambf_client import Light

__all__ = ["Light"]
