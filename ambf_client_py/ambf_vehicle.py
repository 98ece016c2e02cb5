"""Module of the original client: import Vehicle from here or from ambf_client."""

from ambf_client import Vehicle

__all__ = ["Vehicle"]
