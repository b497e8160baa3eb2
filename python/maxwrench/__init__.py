"""How strongly a redundant robot can push, lift or twist, in which posture and with which efforts."""

from ._core import *  # noqa: F401,F403
from ._core import __version__
