"""The window of the control panels, and how it is started: ambf-cli panel [BODY ...]"""

import argparse
import time
import tkinter as tk
from tkinter import ttk
from typing import TYPE_CHECKING, Any

from ambf_tools.panels import theme
from ambf_tools.panels.body import BodyTab
from ambf_tools.panels.joints import JointsTab, Robot

if TYPE_CHECKING:
    from ambf_client import Client
    from ambf_client.services import Listing

    from ambf_tools.cli.output import Output

_TICK = 40  # ms
# A Tcl interpreter must be freed by the thread that made it, or it aborts the program; any thread may collect garbage.
_interpreters: list[Any] = []
_SILENT = 1.0  # s without a state, after which the window says so


def robots_of(client: "Client", listing: "Listing", names: list[str]) -> list[Robot]:
    """The robots of the bodies named; without names, of all bodies that carry joints and hang on none."""
    if not names:
        children = {joint.child for joint in listing.joints}
        parents = {joint.parent for joint in listing.joints}
        names = [each.topic for each in listing.objects if each.topic and each.name in parents - children]
    robots = []
    common = len({name.strip("/").split("/")[0] for name in names}) <= 1
    for name in names:
        handle = client.wait_for(name)
        if not hasattr(handle, "get_joint_names") or not handle.get_joint_names():
            continue
        listed = {handle.find_joint(each.name)[0]: each for each in listing.joints}
        short = handle.get_name().removeprefix(client.get_common_namespace()) if common else handle.get_name()
        robot = Robot(short, handle)
        for index, joint in enumerate(handle.get_joint_names()):
            info = listed.get(index)
            if info is not None and info.limits is not None:
                robot.limits[joint] = info.limits
            if info is not None and info.type in ("prismatic", "linear spring"):
                robot.sliding.add(joint)
        robots.append(robot)
    return robots


def movable(client: "Client", listing: "Listing") -> list[str]:
    """The objects that take poses as commands."""
    from ambf_client.kinds import handle_class

    types = client._objects.kinds()
    handles = {each.topic: handle_class(types[each.topic]) for each in listing.objects if each.topic in types}
    return [topic for topic, handle in handles.items() if "pose" in getattr(handle.command_type, "__slots__", ())]


class PanelWindow:
    """Joints and bodies in two tabs, and below them how the simulation fares."""

    def __init__(self, client: "Client", listing: "Listing", names: list[str]) -> None:
        self.root = tk.Tk()
        _interpreters.append(self.root.tk)
        self.root.title("AMBF control panel")
        self.root.geometry("1420x820")
        self.root.minsize(980, 480)
        self.root.configure(background=theme.BACKGROUND)
        theme.apply(self.root)
        self._client = client
        self._world = client.world
        self._last_step = (-1, time.monotonic())
        self.tabs = ttk.Notebook(self.root)
        self.joints = JointsTab(self.tabs, robots_of(client, listing, names))
        self.body = BodyTab(self.tabs, movable(client, listing), client.get_obj_handle)
        if self.joints.groups:
            self.tabs.add(self.joints, text="Joints")
        self.tabs.add(self.body, text="Object")
        self.status = ttk.Label(self.root, style="Faint.TLabel", padding=(14, 5))
        self.status.pack(side="bottom", fill="x")
        self.tabs.pack(fill="both", expand=True)
        if names and not self.joints.groups:
            self.body.choose(client.wait_for(names[0]).get_name())
        self.root.protocol("WM_DELETE_WINDOW", self.close)
        self._closed = False
        self._tick()

    def run(self) -> None:
        """Until the window is closed."""
        self.root.mainloop()

    def close(self) -> None:
        """Lets go of everything and closes the window."""
        if self._closed:
            return
        self._closed = True
        self.joints.release()
        self.body.release()
        self.root.destroy()

    def _tick(self) -> None:
        import rospy

        if self._closed:
            return
        if rospy.is_shutdown():
            self.close()
            return
        self.joints.update_values()
        self.body.update_values()
        self._show_status()
        self.root.after(_TICK, self._tick)

    def _show_status(self) -> None:
        now = time.monotonic()
        step = self._world.get_sim_step()
        if self._world.has_state() and step != self._last_step[0]:
            self._last_step = (step, now)
        commanded = self.joints.commanded + self.body.commanded
        what = f"{commanded} commanded" if commanded else "nothing commanded"
        if now - self._last_step[1] > _SILENT:
            self.status.configure(
                text=f"no new step for {now - self._last_step[1]:.0f} s: paused, or ended   ·   {what}"
            )
            self.status.configure(foreground=theme.WARNING)
        else:
            at = f"step {self._last_step[0]}, {self._world.get_sim_time():.1f} s"
            self.status.configure(text=f"connected   ·   {at}   ·   {what}", foreground=theme.FAINT)


def panel_command(options: argparse.Namespace, output: "Output") -> None:
    """ambf-cli panel"""
    from ambf_client import Client

    from ambf_tools.cli.simulation import CommandError, Simulation

    simulation = Simulation(options.ns)
    topics = [simulation.object(name).topic for name in options.names]
    with Client("ambf_panel", namespace=simulation.world.rpartition("/")[0]) as client:
        try:
            window: Any = PanelWindow(client, simulation.listing, topics)
        except tk.TclError as problem:
            raise CommandError(f"no window can be opened: {problem}") from None
        window.run()
