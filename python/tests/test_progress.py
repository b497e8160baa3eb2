"""What a search shows while it runs."""

import io
import sys
from types import ModuleType, SimpleNamespace

import maxwrench as mw


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_terminal_has_one_line_which_is_erased(monkeypatch):
    monkeypatch.setattr(sys, "stderr", Terminal())
    with mw.progress(2000, "uvms/valve", after=0) as show:
        show(500)
        assert sys.stderr.getvalue() == "\r\x1b[Kuvms/valve: 500 evaluations (25 %)"
        assert show(1500) is None  # True would end the search
    assert sys.stderr.getvalue().endswith("(75 %)\r\x1b[K") and "\n" not in sys.stderr.getvalue()


def test_nothing_is_shown_early_or_elsewhere(monkeypatch):
    monkeypatch.setattr(sys, "stderr", Terminal())
    with mw.progress(after=60) as show:
        show(1)
    assert sys.stderr.getvalue() == ""
    monkeypatch.setattr(sys, "stderr", io.StringIO())
    with mw.progress(after=0) as show:
        show(1)
    assert sys.stderr.getvalue() == ""


def test_a_notebook_updates_its_area(monkeypatch):
    shown = []
    area = SimpleNamespace(update=lambda data, raw: shown.append(data["text/plain"]))

    def display(data, raw, display_id):
        shown.append(data["text/plain"])
        return area

    ipython = ModuleType("IPython")
    ipython.display, ipython.get_ipython = SimpleNamespace(display=display), lambda: SimpleNamespace(kernel=1)
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    monkeypatch.setitem(sys.modules, "ipykernel", ModuleType("ipykernel"))
    with mw.progress(after=0) as show:
        show(1000)
        show(2000)
    assert shown == ["1,000 evaluations", "2,000 evaluations", ""]


def test_a_search_reports_its_evaluations():
    counts = []

    def callback(evaluations):
        counts.append(evaluations)
        return len(counts) == 3

    mw.solve("uvms/valve", search="annealing", budget=10**8, callback=callback)
    assert len(counts) >= 3 and counts == sorted(counts) and counts[2] > 0
