"""Ctrl-C ends every script within a second, whatever it is doing."""

from __future__ import annotations

import os
import signal
import threading
import time
from types import FrameType

import rospy

_PATIENCE = 0.25  # s for a loop `while not rospy.is_shutdown()` to end by itself


def end_on_interrupt() -> None:
    """Replaces rospy's handler of SIGINT, which ends only scripts that ask rospy.is_shutdown().

    Ours shuts the node down too; a main thread that is still at it a little later gets a KeyboardInterrupt.
    """
    if threading.current_thread() is not threading.main_thread():
        return
    if signal.getsignal(signal.SIGINT) is rospy.core._ros_signal:
        signal.signal(signal.SIGINT, _on_interrupt)


def _on_interrupt(number: int, frame: FrameType | None) -> None:
    if rospy.is_shutdown():
        raise KeyboardInterrupt
    # Elsewhere: the interrupted code may hold what shutting down needs.
    threading.Thread(target=_shut_down, name="ambf_client interrupt", daemon=True).start()


def _shut_down() -> None:
    ending = threading.Thread(target=rospy.signal_shutdown, args=("Ctrl-C",), daemon=True)
    ending.start()
    time.sleep(_PATIENCE)
    main = threading.main_thread()
    if main.is_alive() and rospy.is_shutdown():
        signal.pthread_kill(main.ident or os.getpid(), signal.SIGINT)
