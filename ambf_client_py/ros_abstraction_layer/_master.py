"""The ROS master, asked with a time limit: rospy's own calls wait for as long as it is silent."""

from __future__ import annotations

import http.client
import os
import socket
import xmlrpc.client
from typing import Any

_TIMEOUT = 1.0  # s; a master or node that takes longer counts as silent


class MasterSilent(ConnectionError):
    """The master does not answer. slow: it may only be busy."""

    slow = False


class MasterLink:
    """Calls of the master of this process's environment, in the name of the node `caller`."""

    def __init__(self, caller: str) -> None:
        self.uri = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
        self._caller = caller

    def answers(self) -> bool:
        """Whether there is a master."""
        try:
            self.ask("getPid")
        except MasterSilent:
            return False
        return True

    def ask(self, method: str, *arguments: Any) -> Any:
        """What the master answers; MasterSilent when it does not, LookupError when it refuses."""
        try:
            with proxy(self.uri) as master:
                code, message, value = getattr(master, method)(self._caller, *arguments)
        except (OSError, http.client.HTTPException, xmlrpc.client.Error) as error:
            silent = MasterSilent(f"{self.uri}: {error}")
            silent.slow = isinstance(error, TimeoutError)
            raise silent from error
        if code != 1:
            raise LookupError(f"{method}: {message}")
        return value


class _Transport(xmlrpc.client.Transport):
    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        connection = super().make_connection(host)
        connection.timeout = _TIMEOUT
        return connection


def proxy(uri: str) -> Any:
    """A server, asked with that time limit."""
    return xmlrpc.client.ServerProxy(uri, transport=_Transport())


def describe_uri(uri: str) -> str:
    """The URI, and what may be wrong with it."""
    host = uri.partition("//")[2].partition(":")[0].rstrip("/")
    try:
        socket.getaddrinfo(host, None)
    except OSError:
        return f"{uri} (there is no host '{host}': check ROS_MASTER_URI)"
    return uri
