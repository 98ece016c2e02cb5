"""A display of its own for a test, and a user at it: pictures, keys, mouse, dropped files."""

import contextlib
import os
import subprocess
import time
import urllib.parse

from harness import SLOWNESS
from Xlib import XK, X, display
from Xlib.error import BadWindow, ConnectionClosedError
from Xlib.ext import xtest
from Xlib.protocol import event

SCREEN = (800, 600)
TITLE = "AMBF Simulator Window "


def eventually(condition, seconds, what):
    """The first true value of condition()."""
    end = time.monotonic() + seconds * SLOWNESS
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"not within {seconds} s: {what() if callable(what) else what}")


class XServer:
    def __init__(self):
        read, write = os.pipe()
        self.process = subprocess.Popen(
            [
                "Xvfb",
                "-displayfd",
                str(write),
                "-screen",
                "0",
                "{}x{}x24".format(*SCREEN),
                "-nolisten",
                "tcp",
                "-noreset",
            ],
            pass_fds=[write],
            stderr=subprocess.DEVNULL,
        )
        os.close(write)
        with os.fdopen(read) as number:
            self.name = ":" + number.readline().strip()

    def kill(self):
        self.process.kill()
        self.process.wait()


class User:
    """Sits at one display and looks at the windows of the simulator."""

    def __init__(self, name):
        self.display = display.Display(name)
        self.root = self.display.screen().root

    def close(self):
        with contextlib.suppress(ConnectionClosedError):  # when the server died before
            self.display.close()

    def title_of(self, window):
        value = window.get_full_property(self.display.intern_atom("_NET_WM_NAME"), X.AnyPropertyType)
        return value.value.decode() if value else ""

    def windows(self):
        """Those that are shown, by number."""
        found = {}
        for window in self.root.query_tree().children:
            try:
                title = self.title_of(window)
                if window.get_attributes().map_state == X.IsViewable and title.startswith(TITLE):
                    found[int(title[len(TITLE) :].split()[0])] = window
            except BadWindow:
                continue
        return found

    def window(self, number=1):
        """Once it is there; it gets the keyboard."""
        window = eventually(lambda: self.windows().get(number), 30.0, f"window {number}")
        window.set_input_focus(X.RevertToParent, X.CurrentTime)
        self.display.sync()
        return window

    def title(self, number=1):
        window = self.windows().get(number)
        return self.title_of(window) if window else ""

    def place(self, number=1):
        """(left, top, width, height) on the screen."""
        window = self.windows()[number]
        size, corner = window.get_geometry(), window.translate_coords(self.root, 0, 0)
        return -corner.x, -corner.y, size.width, size.height

    def ask_to_close(self, window):
        """As the cross in a title bar does."""
        atom = self.display.intern_atom
        data = (32, [atom("WM_DELETE_WINDOW"), X.CurrentTime, 0, 0, 0])
        window.send_event(event.ClientMessage(window=window, client_type=atom("WM_PROTOCOLS"), data=data))
        self.display.sync()

    def resize(self, window, width, height):
        window.configure(width=width, height=height)
        self.display.sync()

    def minimise(self, window):
        """What a window manager does then."""
        state = self.display.intern_atom("WM_STATE")
        window.change_property(state, state, 32, [3, 0])  # IconicState
        window.unmap()
        self.display.sync()

    def colours(self, number=1):
        """How many different ones a window shows, roughly."""
        left, top, width, height = self.place(number)
        x, y = max(left, 0), max(top, 0)
        area = (x, y, min(width, SCREEN[0] - x), min(height, SCREEN[1] - y))
        picture = self.root.get_image(*area, X.ZPixmap, 0xFFFFFFFF).data
        return len({picture[i : i + 3] for i in range(0, len(picture), 4 * 97)})

    def picture(self):
        """Bytes of the screen, four a pixel: blue, green, red, nothing."""
        return self.root.get_image(0, 0, *SCREEN, X.ZPixmap, 0xFFFFFFFF).data

    def picture_of(self, number):
        left, top, width, height = self.place(number)
        return self.root.get_image(left, top, width, height, X.ZPixmap, 0xFFFFFFFF).data

    def key(self, name, *modifiers):
        codes = [self.display.keysym_to_keycode(XK.string_to_keysym(each)) for each in (*modifiers, name)]
        for code in codes:
            xtest.fake_input(self.display, X.KeyPress, code)
        for code in reversed(codes):
            xtest.fake_input(self.display, X.KeyRelease, code)
        self.display.sync()

    def hold(self, name, pressed):
        code = self.display.keysym_to_keycode(XK.string_to_keysym(name))
        xtest.fake_input(self.display, X.KeyPress if pressed else X.KeyRelease, code)
        self.display.sync()

    def point(self, x, y):
        xtest.fake_input(self.display, X.MotionNotify, x=x, y=y)
        self.display.sync()

    def button(self, number, pressed):
        xtest.fake_input(self.display, X.ButtonPress if pressed else X.ButtonRelease, number)
        self.display.sync()

    def drag(self, number, start, end, steps=10):
        self.point(*start)
        self.button(number, True)
        for i in range(1, steps + 1):
            self.point(*(round(a + (b - a) * i / steps) for a, b in zip(start, end, strict=True)))
            time.sleep(0.02)
        self.button(number, False)

    def drop(self, window, paths):
        """Drops files by the XDND protocol, version 5, as file managers do; returns once the window took them."""
        atom = self.display.intern_atom
        selection, uri_list = atom("XdndSelection"), atom("text/uri-list")
        source = self.root.create_window(-10, -10, 1, 1, 0, X.CopyFromParent, event_mask=X.PropertyChangeMask)
        source.set_selection_owner(selection, X.CurrentTime)
        urls = "".join("file://" + urllib.parse.quote(str(path)) + "\r\n" for path in paths).encode()

        def tell(message, *values):
            data = [source.id, *values] + [0] * (4 - len(values))
            window.send_event(event.ClientMessage(window=window, client_type=atom(message), data=(32, data)))
            self.display.flush()

        place = self.root.translate_coords(window, 50, 50)
        tell("XdndEnter", 5 << 24, uri_list)
        tell("XdndPosition", 0, abs(place.x) << 16 | abs(place.y), X.CurrentTime, atom("XdndActionCopy"))
        end = time.monotonic() + 20.0
        while time.monotonic() < end:
            if not self.display.pending_events():
                time.sleep(0.01)
                continue
            got = self.display.next_event()
            if got.type == X.SelectionRequest:
                got.requestor.change_property(got.property, uri_list, 8, urls)
                answer = event.SelectionNotify(
                    time=got.time,
                    requestor=got.requestor,
                    selection=got.selection,
                    target=got.target,
                    property=got.property,
                )
                got.requestor.send_event(answer)
                self.display.flush()
            elif got.type == X.ClientMessage and got.client_type == atom("XdndStatus"):
                assert got.data[1][1] & 1, "the window does not want files"
                tell("XdndDrop", 0, X.CurrentTime)
            elif got.type == X.ClientMessage and got.client_type == atom("XdndFinished"):
                source.destroy()
                return
        raise AssertionError("the window did not take the files")
