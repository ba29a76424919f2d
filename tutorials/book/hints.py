"""What a reference shows when one points at it: the equations and the terms of the glossary that pages link to, as a script."""
import json
import re
from pathlib import Path

MATHML = re.compile(r'<span class="?katex-mathml"?>.*?</math></span>', re.S)  # of the page; a hint is for the eye


def write(app, error):
    if error is not None or app.builder.format != "html":
        return
    pages = {path.name: path.read_text() for path in Path(app.outdir).glob("*.html")}
    asked = {link for page in pages.values() for link in re.findall(r'href="?(\w+\.html#(?:eq-|term_)[\w-]+)', page)}
    hints = {}
    for name, page in pages.items():
        found = re.findall(r'<div class="?equation"?[^>]* id="?(eq-[\w-]+)"?>(.*?)</div>', page, re.S)
        found += re.findall(r'<span id="?(term_[\w-]+)"?>.*?</td>\s*<td>(?:<p>)?(.*?)(?:</p>)?</td>', page, re.S)
        hints.update({f"{name}#{place}": MATHML.sub("", what).strip() for place, what in found if f"{name}#{place}" in asked})
    missing = sorted(asked - hints.keys())
    if missing:
        raise ValueError(f"no equation and no term: {missing[0]}")
    (Path(app.outdir) / "_static/hints.js").write_text(f"window.ANTILOCK_HINTS={json.dumps(hints, ensure_ascii=False)};")


def setup(app):
    app.connect("build-finished", write, priority=900)  # of the pages as they are in the end
    return {"parallel_read_safe": True, "parallel_write_safe": True}
