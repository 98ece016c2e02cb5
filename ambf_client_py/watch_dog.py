"""Module of the original client: import WatchDog from here or from ambf_client."""

from ambf_client import WatchDog

__all__ = ["WatchDog"]
