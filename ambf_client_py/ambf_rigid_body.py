"""Module of the original client: import RigidBody from here or from ambf_client."""

from ambf_client import RigidBody

__all__ = ["RigidBody"]
