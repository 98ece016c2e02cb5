"""Ctrl-C ends every script within a second by a KeyboardInterrupt, whatever it is doing."""

from __future__ import annotations

import os
import signal
import threading
import time
from types import FrameType
from typing import Any

import rospy

_PATIENCE = 0.25  # s for a loop `while not rospy.is_shutdown()` to end by itself
_PACKAGES = ("ambf_client", __name__.partition(".")[0])  # a Ctrl-C raises at once in calls of these
_interrupted = False


def init_node(name: str) -> None:
    """Makes this process a ROS node, with our handler of SIGINT where the main thread calls this.

    rospy's own handler is not installed before that: it would turn a Ctrl-C meanwhile into a ROSInitException.
    """
    rospy.init_node(name, anonymous=True, disable_signals=True)
    if threading.current_thread() is not threading.main_thread():
        return
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    rospy.core.register_signals()
    end_on_interrupt()
    signal.pthread_sigmask(signal.SIG_SETMASK, blocked)


def end_on_interrupt() -> None:
    """Replaces rospy's handler of SIGINT, which ends only scripts that ask rospy.is_shutdown().

    Ours shuts the node down, too. In a call of ambf_client or of this package it raises KeyboardInterrupt at once;
    elsewhere a little later, so that such loops can end by themselves.
    """
    if threading.current_thread() is not threading.main_thread():
        return
    if signal.getsignal(signal.SIGINT) is rospy.core._ros_signal:
        signal.signal(signal.SIGINT, _on_interrupt)


def raise_if_interrupted(cause: BaseException | None = None) -> None:
    """Raises KeyboardInterrupt in a main thread whose node a Ctrl-C is shutting down: what fails then fails by that."""
    main = threading.current_thread() is threading.main_thread()
    if main and _interrupted and (rospy.core.is_shutdown_requested() or rospy.is_shutdown()):
        raise KeyboardInterrupt from cause


def _on_interrupt(number: int, frame: FrameType | None) -> None:
    global _interrupted
    _interrupted = True
    if rospy.is_shutdown():
        raise KeyboardInterrupt
    in_call = _in_package(frame)
    # Elsewhere: the interrupted code may hold what shutting down needs.
    threading.Thread(target=_shut_down, args=(in_call,), name="ambf_client interrupt", daemon=True).start()
    if in_call:
        raise KeyboardInterrupt


def _in_package(frame: FrameType | None) -> bool:
    caller: Any = frame
    while caller is not None:
        if str(caller.f_globals.get("__name__", "")).partition(".")[0] in _PACKAGES:
            return True
        caller = caller.f_back
    return False


def _shut_down(raised: bool) -> None:
    if raised:  # the script's own clean-up comes first
        time.sleep(_PATIENCE)
    ending = threading.Thread(target=rospy.signal_shutdown, args=("Ctrl-C",), daemon=True)
    ending.start()
    if raised:
        return
    time.sleep(_PATIENCE)
    main = threading.main_thread()
    if main.is_alive() and rospy.is_shutdown():
        signal.pthread_kill(main.ident or os.getpid(), signal.SIGINT)
