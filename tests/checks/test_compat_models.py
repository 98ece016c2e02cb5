"""The compatibility tests find the models they need. Without them CI would pass having tested nothing."""

import os
import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_compatibility_models_are_there():
    folder = pathlib.Path(os.environ.get("AMBF_COMPAT_DIR", ROOT / "../shared/compat"))
    if any(folder.rglob("*.yaml")):
        return
    message = f"no compatibility models in {folder} (set AMBF_COMPAT_DIR)"
    if os.environ.get("CI") == "true":
        pytest.fail(message)
    pytest.skip(message)
