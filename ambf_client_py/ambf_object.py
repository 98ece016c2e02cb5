"""Module of the original client: import Object from here or from ambf_client."""

from ambf_client import Object

__all__ = ["Object"]
