"""A frame that scrolls when it is higher than its window."""

import tkinter as tk
from tkinter import ttk

from ambf_tools.panels import theme


class ScrolledFrame(ttk.Frame):
    """Put widgets into `inside`."""

    def __init__(self, parent: tk.Misc, width: int) -> None:
        super().__init__(parent)
        self._canvas = tk.Canvas(self, background=theme.BACKGROUND, highlightthickness=0, width=width)
        bar = ttk.Scrollbar(self, orient="vertical", command=self._canvas.yview)
        self._canvas.configure(yscrollcommand=bar.set)
        bar.pack(side="right", fill="y")
        self._canvas.pack(side="left", fill="both", expand=True)
        self.inside = ttk.Frame(self._canvas)
        item = self._canvas.create_window(0, 0, window=self.inside, anchor="nw")
        self.inside.bind("<Configure>", lambda _: self._canvas.configure(scrollregion=self._canvas.bbox("all")))
        self._canvas.bind("<Configure>", lambda event: self._canvas.itemconfigure(item, width=event.width))
        top = self.winfo_toplevel()
        top.bind("<Button-4>", lambda event: self._scroll(event, -2), add="+")
        top.bind("<Button-5>", lambda event: self._scroll(event, 2), add="+")

    def _scroll(self, event: "tk.Event[tk.Misc]", lines: int) -> None:
        if self.winfo_ismapped() and str(event.widget).startswith(str(self)):
            self._canvas.yview_scroll(lines, "units")
