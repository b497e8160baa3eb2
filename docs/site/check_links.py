"""check_links.py HTML: every link and picture of the site leads to a file of the site, and every anchor exists."""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.loaded = set(), [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("id", "name"):
                self.anchors.add(value)
            elif key in ("href", "src") and value:
                self.links.append(value)
                if tag in ("img", "script", "link"):
                    self.loaded.append(value)


def faults(root, pages):
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme == "data":
                continue
            name = path.relative_to(root)
            if parts.scheme or parts.netloc:
                if link in page.loaded:
                    yield f"{name}: {link}: needs the network"
                continue
            target = path if not parts.path else (path.parent / urllib.parse.unquote(parts.path)).resolve()
            if not target.is_file():
                yield f"{name}: {link}: no such file"
            elif parts.fragment and target in pages and urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                yield f"{name}: {link}: no such anchor"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path) for path in root.rglob("*.html") if "_static" not in path.parts}
    found = sorted(set(faults(root, pages)))
    for fault in found:
        print(fault, file=sys.stderr)
    print(f"{sum(len(page.links) for page in pages.values())} links, {len(found)} broken")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
