"""Module of the original client: import Camera from here or from ambf_client."""

from ambf_client import Camera

__all__ = ["Camera"]
