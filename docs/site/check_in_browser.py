"""check_in_browser.py HTML: every page at 1280 and 390 px in a headless Chromium, and searches that a new user may try.

No page is wider than the screen, all formulas are typeset, all pictures load, and each search has the page that answers it among its first
three results.
"""

import functools
import http.server
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import threading

SEARCHES = {
    "added mass": "docs/algorithms/dynamics",
    "inverse kinematics solutions": "docs/algorithms/dependent_coordinates",
    "certificate": "docs/algorithms/certificates",
    "thrust curve": "docs/robot_files",
    "multiplier": "docs/algorithms/sensitivities",
    "friction cone": "docs/robot_files",
    "branch and bound": "docs/algorithms/proofs",
    "cmaes": "docs/algorithms/searches/cmaes",
    "load_problem": "reference/cpp/load",
    "how to bring my own URDF": "docs/questions",
    "own URDF": "docs/own_robot",
    "what does optimal mean": "docs/questions",
    "thruster dead": "docs/algorithms/scenarios",
    "Python install": "docs/install",
    "certificate verify": "docs/algorithms/certificates",
    "from_urdf": "reference/python/tasks_and_robots",
    "Ctrl-C": "docs/questions",
    "unit of beta": "docs/questions",
}
WIDTHS = [1280, 390]
OF_THE_COMMAND = {"gallery", "report"}  # folders of pages that have tests of their own
DRIVER = (pathlib.Path(__file__).parent / "check.js").read_text(encoding="utf-8")


class Handler(http.server.SimpleHTTPRequestHandler):
    """Serves the site and the page that looks at it."""

    missing, driver = [], b""

    def do_GET(self):
        if self.path != "/driver.html":
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.end_headers()
        self.wfile.write(self.driver)

    def send_error(self, code, message=None, explain=None):
        self.missing.append(f"{self.path}: {code}")
        super().send_error(code, message, explain)

    def log_message(self, *args):
        pass


def browse(root, pages):
    """What the driver reports of the pages, or one line if Chromium does not get to the end."""
    task = json.dumps({"pages": pages, "widths": WIDTHS, "searches": SEARCHES})
    Handler.driver = f"<!doctype html><body><pre id='found'></pre><script>const task = {task};\n{DRIVER}</script></body>".encode()
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Handler, directory=root))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory() as profile:
        shown = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", "--timeout=400000",
                                "--virtual-time-budget=100000000", "--dump-dom", f"http://127.0.0.1:{server.server_port}/driver.html"],
                               capture_output=True, text=True, timeout=500)
    server.shutdown()
    found = re.search(r"<pre id=.found.>(.*?)</pre>", shown.stdout, re.DOTALL)
    lines = found[1].splitlines() if found else []
    if not lines or lines.pop() != "the end":
        return [*lines, "Chromium did not look at all pages"]
    return lines + sorted(set(line for line in Handler.missing if "favicon" not in line))


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    paths = [path.relative_to(root) for path in root.rglob("*.html")]
    pages = sorted(path.as_posix() for path in paths if path.parts[0] not in {"_static", *OF_THE_COMMAND})
    faults = browse(root, pages)
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(pages)} pages at {WIDTHS[0]} and {WIDTHS[1]} px, {len(SEARCHES)} searches, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
