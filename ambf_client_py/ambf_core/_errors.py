"""What a world raises beside ValueError (wrong arguments and commands) and RuntimeError (misuse)."""

from __future__ import annotations

from collections.abc import Sequence


class LoadError(ValueError):
    """A file or text was refused. `findings` are the loader's, with file, line and column; nothing was loaded."""

    def __init__(self, message: str, findings: Sequence[str]) -> None:
        super().__init__("\n".join([message, *findings]))
        self.message, self.findings = message, list(findings)

    def __reduce__(self) -> tuple[type[LoadError], tuple[str, list[str]]]:
        return LoadError, (self.message, self.findings)


class Diverged(RuntimeError):
    """The world has stopped: `body` is not finite or absurdly fast, and nothing else moves. reset() or restore() it."""

    def __init__(self, body: str) -> None:
        super().__init__(f"the world has diverged: '{body}' is not finite or absurdly fast; reset or restore it")
        self.body = body
