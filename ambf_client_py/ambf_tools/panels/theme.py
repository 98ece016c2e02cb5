"""Colours, fonts and widget styles of the panels."""

import tkinter as tk
from tkinter import font, ttk

BACKGROUND = "#f4f5f7"
CARD = "#ffffff"
LINE = "#d9dde3"
TEXT = "#1f2933"
FAINT = "#7b8794"
COMMANDED = "#2a6fbb"
MEASURED = "#e07b39"
WARNING = "#c0392b"
GOOD = "#3c9a5f"
CURVES = ("#2a6fbb", "#e07b39", "#4b9e5f", "#8a63b8", "#c2477f", "#6b7a8f", "#b08d2f", "#2f9aa8")


def apply(root: tk.Misc) -> None:
    """Gives all widgets of a window our looks."""
    families = set(font.families(root))
    family = next((name for name in ("Inter", "Noto Sans", "DejaVu Sans") if name in families), "TkDefaultFont")
    for name, size in (("TkDefaultFont", 10), ("TkTextFont", 10), ("TkMenuFont", 10), ("TkHeadingFont", 10)):
        font.nametofont(name, root).configure(family=family, size=size)
    style = ttk.Style(root)
    style.theme_use("clam")
    style.configure(".", background=BACKGROUND, foreground=TEXT, bordercolor=LINE, lightcolor=LINE, darkcolor=LINE)
    style.configure("Card.TFrame", background=CARD)
    style.configure("TLabel", background=BACKGROUND)
    style.configure("Card.TLabel", background=CARD)
    style.configure("Faint.TLabel", background=BACKGROUND, foreground=FAINT)
    style.configure("FaintCard.TLabel", background=CARD, foreground=FAINT)
    style.configure("Group.TLabel", background=BACKGROUND, font=(family, 11, "bold"))
    style.configure("Title.TLabel", background=BACKGROUND, font=(family, 14, "bold"))
    style.configure("TButton", background=CARD, padding=(12, 4), width=0, relief="flat", focuscolor=LINE)
    style.map("TButton", background=[("pressed", "#dfe5ec"), ("active", "#eaeef3")])
    style.configure("Accent.TButton", background=COMMANDED, foreground="#ffffff")
    style.map("Accent.TButton", background=[("pressed", "#1f5690"), ("active", "#357fce")])
    style.configure("Small.TButton", padding=(6, 1))
    style.configure("TEntry", fieldbackground=CARD, padding=3)
    style.configure("TCombobox", fieldbackground=CARD, background=CARD, padding=2, arrowsize=12)
    style.map("TCombobox", fieldbackground=[("readonly", CARD)], selectbackground=[("readonly", CARD)])
    style.map("TCombobox", selectforeground=[("readonly", TEXT)])
    style.configure("Card.TCheckbutton", background=CARD)
    style.map("Card.TCheckbutton", background=[("active", CARD)])
    style.configure("TNotebook", background=BACKGROUND, borderwidth=0)
    style.configure("TNotebook.Tab", padding=(16, 6), background="#e6e9ee")
    style.map("TNotebook.Tab", background=[("selected", CARD)], padding=[("selected", (16, 6))], expand=[])
    style.configure("Vertical.TScrollbar", background="#c9d0d9", troughcolor=BACKGROUND, arrowsize=12)


def colour_of(index: int) -> str:
    """The colour of a plot's curve."""
    return CURVES[index % len(CURVES)]


def readable(value: float) -> str:
    """A number in few characters."""
    if value != value:
        return "–"
    if abs(value) < 0.0005:
        return "0.000"
    return f"{value:.3f}" if abs(value) < 1000 else f"{value:.4g}"


def short(value: float) -> str:
    """The same, shorter."""
    return f"{value:.2f}".rstrip("0").rstrip(".") if abs(value) < 1000 else f"{value:.3g}"


def elided(name: str, most: int) -> str:
    """A name without its middle, where it is too long."""
    if len(name) <= most:
        return name
    return f"{name[: most // 2 - 1]}…{name[-(most - most // 2) :]}"
