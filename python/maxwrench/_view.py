"""Pages of answers, as the command ``maxwrench view`` writes them."""

from html import escape

from . import _core
from ._files import write_bytes


class Page:
    """An HTML page in which the robot can be turned and the answer be seen.

    It needs no other file and no network; it has about two megabytes. A notebook shows it in the cell.
    ``Answer.view`` makes one.

    Attributes: ``html``, its text; ``height``, that of the frame in a notebook [pixels].

    >>> page = maxwrench.solve("planar/force", budget=500).view()
    >>> page.html.startswith("<!DOCTYPE html>")
    True
    """

    def __init__(self, html, title, height=640):
        self.html, self.height = html, height
        self._title = title

    def save(self, path):
        """Writes the page into the file ``path``, whole or not at all."""
        write_bytes(path, self.html.encode())

    def __repr__(self):
        return f"<Page {self._title}: {len(self.html.encode()) / 1e6:.1f} MB>"

    def _repr_html_(self):
        style = f"width: 100%; height: {self.height}px; border: 0"
        return f'<iframe title="{escape(self._title)}" style="{style}" srcdoc="{escape(self.html)}"></iframe>'


def view_answer(answer, out=None, tank=False):
    """Makes the page in which the robot can be turned and the answer be seen.

    It is the page of the command ``maxwrench view``: this answer, and the task's default posture or
    trajectory beside it. Mesh files of the robot are drawn where its URDF names them.

    Args:
        answer: an Answer with a posture.
        out: HTML file to write, replaced as a whole. None: no file.
        tank: whether to add what the virtual tank reads along each trajectory of a task in time.

    Returns:
        Page: the page, which a notebook shows in the cell.

    Raises:
        InputError: the answer has no posture, or ``tank`` is given for a task that the virtual tank does not support.
        OSError: the file cannot be written.

    >>> answer = maxwrench.solve("planar/force", budget=500)
    >>> answer.view("posture.html")  # doctest: +ELLIPSIS
    <Page planar/force: ... MB>
    """
    page = Page(_core._page(answer, tank), answer.task.name)
    if out is not None:
        page.save(out)
    return page
