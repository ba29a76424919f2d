"""The slides of a lecture: in a page of Markdown each section is a slide.

Sphinx makes the page as it makes every other one, so its formulas are set and its links are
checked. Then `deck` takes its sections out of the theme. The line `:figure: NAME` stands for the
picture of a slide, by its name in figures/table.toml.
"""
import json
import re
from pathlib import Path

NAMES = [f"lecture_{number}" for number in (1, 2, 3, 4)]
WIDE = 1.9  # a picture whose width over its height is larger stands below the words
PLACE = re.compile(r":figure:\s*(\S+)$")
SHOWN = re.compile(r'<div class="[^"]*\bshown (wide|tall)\b[^"]*">\s*(<img[^>]*>)\s*</div>')
SECTION = re.compile(r'<section [^>]*id="([\w-]+)"[^>]*>\s*')
HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width,initial-scale=1">
<title>{title}</title>
<link rel="stylesheet" href="_static/katex.css">
<link rel="stylesheet" href="_static/slides.css">
<script defer src="_static/slides.js"></script></head>
<body><main><article>
"""
FOOT = "</article></main></body></html>\n"


def with_pictures(lines, picture):
    """The lines of Markdown with their pictures. `picture(name)` is (path, caption, aspect) or
    None, where the aspect is the width over the height."""
    out = []
    for line in lines:
        place = PLACE.match(line)
        found = picture(place[1]) if place else None
        if found:
            path, caption, aspect = found
            kind = "wide" if aspect > WIDE else "tall"
            alt = json.dumps(caption, ensure_ascii=False)  # a quoted text of YAML
            image = [f"```{{image}} {path}", f":alt: {alt}", "```"]
            out += [f":::{{container}} shown {kind}", *image, ":::"]
        elif not place:
            out.append(line)
    return out


def slide(identity, content):
    """A slide: its heading, its words, and its picture beside or below them."""
    heading, _, rest = content.partition("</h2>" if "</h2>" in content else "</h1>")
    shown = SHOWN.search(rest)
    words = rest.replace(shown[0], "") if shown else rest
    level = heading[1:3]
    kind = {"wide": "below", "tall": "beside"}[shown[1]] if shown else "words-alone"
    picture = f'<div class="shown">{shown[2]}</div>' if shown else ""
    return (f'<section class="slide {kind}" id="{identity}">{heading}</{level}>\n'
            f'<div class="words">{words.strip()}</div>\n{picture}</section>\n')


def deck(page):
    """The slides of a page of Sphinx: the title and its introduction, then one per section."""
    article = re.search(r"<article[^>]*>(.*)</article>", page, re.S)[1]
    article = re.sub(r'<a class="headerlink".*?</a>', "", article, flags=re.S)
    foot = re.search(r'<p class="foot">.*?</p>', article, re.S)[0]
    parts = SECTION.split(article.replace("</section>", "").replace(foot, ""))[1:]
    identities, contents = parts[::2], parts[1::2]
    contents[0] += foot
    slides = [slide(identity, content) for identity, content in zip(identities, contents)]
    title = re.sub(r"<[^>]*>", "", re.search(r"<h1>(.*?)</h1>", article, re.S)[1])
    return HEAD.format(title=title) + "".join(slides) + FOOT


def write(app, error):
    """Takes the slides out of the theme, in the pages as Sphinx wrote them."""
    if error is None and app.builder.format == "html":
        for path in (Path(app.outdir) / f"{name}.html" for name in NAMES):
            path.write_text(deck(path.read_text()))


def setup(app):
    app.connect("build-finished", write, priority=400)  # before conf.py's own
    return {"parallel_read_safe": True, "parallel_write_safe": True}
