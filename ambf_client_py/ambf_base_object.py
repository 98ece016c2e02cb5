"""Module of the original client: import BaseObject from here or from ambf_client."""

from ambf_client import BaseObject

__all__ = ["BaseObject"]
