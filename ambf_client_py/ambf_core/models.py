"""Where AMBF's own scenes are."""

from __future__ import annotations

from pathlib import Path


def _models() -> Path:
    """Of the wheel, of the installed tree, or of the source tree."""
    here = Path(__file__).resolve().parent
    tried = (here / "models", here / "../../../../share/ambf/models", here / "../../ambf_models")
    return next((each for each in tried if each.is_dir()), tried[-1]).resolve() / "descriptions"


MODELS = _models()
