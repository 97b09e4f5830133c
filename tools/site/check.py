# SPDX-License-Identifier: BSD-3-Clause
"""Check the built site: nothing comes from a network, links lead somewhere, it is small.

Usage: check.py SITE. Links to other sites are listed in SITE/../external_links.txt, not fetched.
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

MOST_BYTES = 30_000_000
#: What an element loads by itself, by its name and attribute.
LOADED = {
    *(("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("video", "src")),
    *(
        ("audio", "src"),
        ("embed", "src"),
        ("object", "data"),
        ("link", "href"),
        ("video", "poster"),
    ),
    *(("img", "srcset"), ("source", "srcset"), ("image", "href"), ("use", "href")),
}
#: Of a link element these load nothing.
_NAMES = ("canonical", "prev", "next", "alternate", "edit")
_STYLED = re.compile(r"""url\(\s*["']?([^"')]+)|@import\s+["']([^"']+)""")


class Page(HTMLParser):
    """What a page loads, where it leads, and its anchors."""

    def __init__(self, path: Path) -> None:
        """Read a file."""
        super().__init__()
        self.loads: list[str] = []
        self.links: list[str] = []
        self.anchors: set[str] = {"", "top"}
        self.style = False
        self.feed(path.read_text("utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what an element loads or names."""
        given = {name: value or "" for name, value in attrs}
        self.style = tag == "style"
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        by_name = tag == "link" and set(given.get("rel", "").split()) & set(_NAMES)
        for name, value in given.items():
            if (tag, name) in LOADED:
                (self.links if by_name else self.loads).append(value)
            if name == "style":
                self.loads += addresses(value)

    def handle_data(self, data: str) -> None:
        """Note what a style loads."""
        if self.style:
            self.loads += addresses(data)


def addresses(style: str) -> list[str]:
    """What a style loads."""
    return [one or other for one, other in _STYLED.findall(style)]


def is_remote(address: str) -> bool:
    """Whether a network would be asked."""
    return address.startswith("//") or urlsplit(address).scheme in (
        "http",
        "https",
        "ftp",
        "ws",
        "wss",
    )


def resolved(page: Path, address: str) -> Path:
    """The file that an address on a page means."""
    return (
        (page.parent / unquote(urlsplit(address).path)).resolve()
        if urlsplit(address).path
        else page
    )


def problems_of(site: Path) -> tuple[list[str], set[str]]:
    """What is wrong, and links to other sites."""
    site = site.resolve()
    wrong: list[str] = []
    external: set[str] = set()
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    reached = {site / "index.html"}
    for path, page in pages.items():
        # It is served from anywhere, so its addresses begin with the root of the server.
        if path.name == "404.html":
            wrong += [f"404.html loads {each}" for each in page.loads if is_remote(each)]
            continue
        name = path.relative_to(site)
        for address in [*page.loads, *page.links]:
            scheme = urlsplit(address).scheme
            if is_remote(address):
                if address in page.loads:
                    wrong.append(f"{name} loads {address} from a network")
                external.add(address)
            elif scheme in ("data", "mailto"):
                continue
            elif scheme:
                wrong.append(f"{name} has a link of an unknown kind: {address}")
            else:
                target, anchor = resolved(path, address), unquote(urlsplit(address).fragment)
                reached.add(target)
                if not target.is_file():
                    wrong.append(f"{name}: {address} leads nowhere")
                elif target in pages and anchor not in pages[target].anchors:
                    wrong.append(f"{name}: {address} has no such anchor")
    for path in sorted(site.rglob("*.css")):
        for address in addresses(path.read_text("utf-8")):
            if is_remote(address):
                wrong.append(f"{path.relative_to(site)} loads {address} from a network")
            elif not address.startswith(("data:", "#")) and not resolved(path, address).is_file():
                wrong.append(f"{path.relative_to(site)}: {address} leads nowhere")
    lost = [path for path in pages if path not in reached and path.name != "404.html"]
    wrong += [f"no page leads to {path.relative_to(site)}" for path in lost]
    size = sum(path.stat().st_size for path in site.rglob("*") if path.is_file())
    if size > MOST_BYTES:
        wrong.append(
            f"the site has {size / 1e6:.1f} MB; at most {MOST_BYTES / 1e6:.0f} MB are allowed"
        )
    if not pages:
        wrong.append(f"{site} has no pages")
    else:
        print(
            f"{len(pages)} pages, {size / 1e6:.1f} MB, {len(external)} links to other sites: "
            f"{site / 'index.html'}"
        )
    return wrong, external


def main(site: Path) -> int:
    """Say what is wrong; the exit code."""
    wrong, external = problems_of(site)
    (site.parent / "external_links.txt").write_text(
        "\n".join(sorted(external)) + "\n", encoding="utf-8"
    )
    for each in wrong:
        print(each, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
