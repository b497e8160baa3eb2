"""Progress of a long search."""

import sys
import time


def progress(budget=0, label="", *, after=0.5):
    """Returns a callback for ``solve`` that shows how far the search is.

    It writes one line on stderr if that is a terminal, or below the cell in a notebook; elsewhere it
    is silent. ``close`` erases the line, as does the end of a with statement.

    Args:
        budget: the largest number of evaluations; 0: not known.
        label: what is solved.
        after: seconds before it shows anything [s].

    Returns:
        Progress: the callback; it takes the number of evaluations.

    >>> with maxwrench.progress(1000, "planar/force") as callback:
    ...     answer = maxwrench.solve("planar/force", budget=1000, callback=callback)
    """
    return Progress(budget, label, after)


class Progress:
    """One line about a search; ``progress`` makes it."""

    def __init__(self, budget, label, after):
        self._budget, self._label = budget, label
        self._shown_from = time.monotonic() + after
        self._show = _in_notebook() or (_on_terminal if sys.stderr.isatty() else None)
        self._visible = False

    def __call__(self, evaluations):
        """Shows the number of evaluations."""
        if self._show is None or time.monotonic() < self._shown_from:
            return
        share = f" ({100 * evaluations // self._budget} %)" if self._budget else ""
        label = f"{self._label}: " if self._label else ""
        self._show(f"{label}{evaluations:,} evaluations{share}")
        self._visible = True

    def close(self):
        """Erases the line."""
        if self._visible:
            self._show("")
        self._visible = False

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def _on_terminal(text):
    sys.stderr.write(f"\r\x1b[K{text}")  # the start of the line, which is erased first
    sys.stderr.flush()


def _in_notebook():
    """What shows a text below the cell of a notebook; None elsewhere."""
    if "ipykernel" not in sys.modules:
        return None
    from IPython import display, get_ipython

    if not hasattr(get_ipython(), "kernel"):
        return None
    area = None

    def show(text):
        nonlocal area
        shown = {"text/plain": text}
        if area is None:
            area = display.display(shown, raw=True, display_id=True)
        else:
            area.update(shown, raw=True)

    return show
