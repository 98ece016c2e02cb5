"""Module of the original client: import World from here or from ambf_client."""

from ambf_client import World

__all__ = ["World"]
