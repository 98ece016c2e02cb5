"""Control panels: windows with sliders for joints and bodies, and plots of what happens. See docs/tools.md."""
