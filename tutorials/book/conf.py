# The book: pages.py has written the Markdown, Sphinx makes the pages. Run: tutorials/book/build
import re
import sys
from pathlib import Path

import myst_parser

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from library import Library, NameLinks  # noqa: E402

project = "Antilock"
author = "the Antilock authors"
html_title = "Antilock"
extensions = ["myst_parser", "katex", "search", "hints", "slides"]
root_doc = "index"
# {width=...} behind a picture: attrs_inline since 0.19
attributes = "attrs_inline" if [int(n) for n in myst_parser.__version__.split(".")[:2]] >= [0, 19] else "attrs_image"
myst_enable_extensions = ["dollarmath", "amsmath", "colon_fence", attributes]
myst_heading_anchors = 3
suppress_warnings = ["myst.header"]  # a step (###) stands where the program has it
html_theme = "furo"
html_static_path = ["style.css", "book.js", "slides.css", "slides.js",
                    "../../build/book-parts/static"]
html_css_files = ["katex.css", "style.css"]
# before live.js, which changes the page
html_js_files = [("book.js", {"defer": "defer", "priority": 400})]
html_copy_source = html_use_index = False
html_show_copyright = html_show_sphinx = False
pygments_style = "xcode"  # of those with enough contrast
pygments_dark_style = "github-dark"


def repair(app, error):
    """Debian's furo was rebuilt without its tools, and lost three things on the way: its script imports but is no
    module, its style asks the web server for normalize.css (bookworm alone), "auto" is never dark."""
    static = Path(app.outdir) / "_static"
    script, style = static / "scripts/furo.js", static / "styles/furo.css"
    if error is None and app.builder.format == "html" and re.match("import .*Gumshoe", script.read_text()):
        script.write_text((static / "scripts/gumshoe-patched.js").read_text() + script.read_text().split("\n", 1)[1])
        asked, css = "/javascript/normalize.css/normalize.css", style.read_text()
        if asked in css:
            (static / "styles/normalize.css").write_text(Path("/usr/share/nodejs/normalize.css/normalize.css").read_text())
            css = css.replace(asked, "normalize.css")
        dark = re.search(r'body\[data-theme="dark"\] (\{.*?\})', css, re.S)[1]
        style.write_text(css + '@media not print { @media (prefers-color-scheme: dark) { body:not([data-theme="light"]) ' + dark + "} }\n")


# The templates of furo name no landmark and give its headings no level, and that of Debian 12 has
# no link past the contents (WCAG 1.3.1, 2.4.1, 4.1.2). That of Debian 13 moves its link into the
# window in 300 ms; this one is there as soon as it has the focus. tests/book runs axe-core on every
# page.
SKIP = '<a class="skip" href="#furo-main-content">Skip to the page</a>'
ACCESSIBLE = (
    (r'<div class="article-container">', '<div class="article-container" role="main">'),
    (r'<article [^>]*role="main"[^>]*>', '<article id="furo-main-content" tabindex="-1">'),
    (r'<aside class="sidebar-drawer">', '<aside class="sidebar-drawer" aria-label="The book">'),
    (r'<aside class="(toc-drawer[^"]*)">', r'<aside class="\1" aria-label="On this page">'),
    (r'<form class="sidebar-search-container" ', r'\g<0>aria-label="The book" '),
    (r'<p class="caption" role="heading">', '<p class="caption" role="heading" aria-level="2">'),
    (r'<a class="skip-to-content [^>]*>[^<]*</a>', ""),
    (r'<label class="overlay ', '<label aria-hidden="true" class="overlay '),
    (r'<th class="head"><p></p></th>', "<td></td>"),
)


def make_accessible(app, error):
    """Runs before `tighten`, on the pages as Sphinx wrote them."""
    if error is None and app.builder.format == "html":
        for path in Path(app.outdir).glob("*.html"):
            text = path.read_text()
            for old, new in ACCESSIBLE:
                text = re.sub(old, new, text)
            if "furo-main-content" in text:
                text = text.replace("<body>", "<body>" + SKIP, 1)
            path.write_text(text)


def tighten(app, error):
    """A fifth of what stands around a page's text, on every page the same, were blanks; in the text, marks that no rule
    of the style asks for."""
    if error is None and app.builder.format == "html":
        for path in Path(app.outdir).glob("*.html"):
            around = re.split(r"(<article.*</article>)", path.read_text(), flags=re.S)
            text = "".join(part if i % 2 else re.sub(r"\s*\n\s*", "\n", part) for i, part in enumerate(around))
            text = re.sub(r'<span class="(?:std std-ref|doc(?: std std-doc)?)">([^<]*)</span>', r"\1", text)
            text = re.sub(r' title="Permalink to this \w+"', "", text)
            text = text.replace('class="reference internal"', 'class="reference"')
            # furo's script is no module any more (repair), and a browser refuses modules of a folder
            text = text.replace('<script type="module" ', "<script defer ")
            parts = re.split(r"(<script.*?</script>)", text, flags=re.S)  # quotation marks that HTML does not need
            unquoted = (re.sub(r"<[a-zA-Z][^<>]*>", lambda tag: re.sub(r'="([\w.#-]+)"(?!\s*/)', r"=\1", tag[0]), part) for part in parts[::2])
            path.write_text("".join(part for pair in zip(unquoted, [*parts[1::2], ""]) for part in pair))


RELEASE = dict(re.findall(r"^(version|license): (\S+)$", (HERE.parents[1] / "CITATION.cff").read_text(), re.M))
FOOT = (f'<p class="foot">Antilock {RELEASE["version"]}, the Antilock authors; licence of the text CC BY 4.0, of the code {RELEASE["license"]}. To cite: L. Slimane and Y. Renard, '
        "J. Comput. Appl. Math. 170 (2004) 121–143, with this software and its version (CITATION.cff).</p>")


def setup(app):
    app.connect("build-finished", repair)
    app.connect("build-finished", make_accessible)
    app.connect("build-finished", tighten)
    links = NameLinks(Library(HERE.parents[1] / "lib"))

    def page(app, name, template, context, doctree):
        body = context.get("body", "")
        if re.search('data-kind="(?:locking|convergence|roundoff)"', body):  # the figures that hold the library themselves
            app.add_js_file("meshes_data.js", loading_method="defer")
            app.add_js_file("live_data.js", loading_method="defer")
        if 'id="search-results"' in body:
            app.add_js_file("search_data.js", loading_method="defer")
        if 'class="live"' in body or 'id="run"' in body or 'id="search-results"' in body:
            app.add_js_file("live.js", loading_method="defer")
        context["script_files"] = [script for script in context["script_files"] if not re.search(r"jquery|underscore|frameworks_compat|doctools|sphinx_highlight|documentation_options", str(script))]
        if not name.startswith("library"):
            body = links(body)
        # names, signs and blanks have the colour of the text: a third of the book's size were their marks
        body = re.sub(r'<span class="(?:n|p|o|w|nb|bp|mi|mf)">([^<]*)</span>', r"\1", body)
        body += FOOT
        context["body"] = re.sub(r'<img alt="([^"]*)" class="lazy"', r'<img alt="\1" loading="lazy" class="lazy"', body)

    app.connect("html-page-context", page)
