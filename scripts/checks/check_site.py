#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether every link of the site leads to a page of it, and every anchor to a place on that page. The references of Doxygen and
Sphinx are linked to, but their own links are theirs.

Usage: scripts/checks/check_site.py SITE
"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, path: pathlib.Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name in ("id", "name") and value:
                self.anchors.add(value)


def main() -> int:
    site = pathlib.Path(sys.argv[1]).resolve()
    foreign = [site / "cpp", site / "python"]
    paths = [path for path in site.rglob("*.html") if not any(path.is_relative_to(folder) for folder in foreign)]
    pages = {path: Page(path) for path in paths if path.name != "404.html"}
    problems = []
    for path, page in sorted(pages.items()):
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if parts.scheme in ("http", "https") and parts.netloc.startswith("fonts."):
                    problems.append(f"{path.relative_to(site)}: loads {link} from the network")
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                problems.append(f"{path.relative_to(site)}: {link} does not exist")
            elif parts.fragment and target in pages and parts.fragment not in pages[target].anchors:
                problems.append(f"{path.relative_to(site)}: {link}: no such place on the page")
    print("\n".join(problems), end="\n" if problems else "")
    return 1 if problems or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
