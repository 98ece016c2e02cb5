"""What programs get when they are started as users start them."""

import os

from harness import ROOT


def environment():
    """That of a user's shell."""
    return dict(os.environ, PYTHONPATH=f"{ROOT / 'ambf_client_py'}:{os.environ.get('PYTHONPATH', '')}")
