#!/usr/bin/env bash
# Makes the book of docs/ in target/book, and fails where a link within it leads nowhere.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tool="mdbook 0.5.4"
home=$PWD/target/book-tools
if [ "$(cat "$home/installed.txt" 2>/dev/null)" != "$tool" ]; then
  if ! cargo info --quiet "mdbook@${tool#* }" >/dev/null 2>&1; then
    echo "error: $tool is not in target/book-tools, and the registry of crates is out of reach" >&2
    exit 69 # that of a service out of reach, told from a book that is wrong
  fi
  cargo install --quiet --locked --no-default-features --features search --root "$home" "mdbook@${tool#* }"
  # Last, because it says that all the rest is there.
  echo "$tool" >"$home/installed.txt"
fi
rm -rf target/book
"$home/bin/mdbook" build docs

python3 - <<'END'
"""Links within the book: the file is there, and so is the heading."""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.names, self.links = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.names.update(found[key] for key in ("id", "name") if found.get(key))
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])


top = pathlib.Path("target/book").resolve()
pages = {path: Page(path.read_text()) for path in top.rglob("*.html") if path.name not in ("404.html", "toc.html")}
broken = []
for path, page in pages.items():
    for link in page.links:
        parts = urllib.parse.urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        to = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
        if top not in to.parents:
            continue  # a file of the repository
        if not to.exists():
            broken.append(f"{path.name}: {link}: no such page")
        elif parts.fragment and to in pages and urllib.parse.unquote(parts.fragment) not in pages[to].names:
            broken.append(f"{path.name}: {link}: no such heading")
print("\n".join(sorted(set(broken))))
sys.exit(bool(broken))
END
echo "target/book/index.html"
