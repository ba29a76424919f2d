"""The index of the search page: the text of every section of every page. Sphinx's own has no text, and so no excerpt."""
import json
import re
from pathlib import Path

from docutils import nodes

import slides
from packed import script, zipped


def spoken(tex):
    """A formula as one would type it."""
    tex = re.sub(r"\\tag\{([^}]*)\}", r" (\1)", re.sub(r"\\(?:text|mathrm|operatorname)\{([^}]*)\}", r"\1", tex))
    return re.sub(r"[{}\\]", "", tex)


def text_of(node):
    """The text of a section without that of the sections in it; of code, the C++ alone."""
    if isinstance(node, (nodes.section, nodes.title, nodes.raw, nodes.comment, nodes.system_message)):
        return ""
    if isinstance(node, (nodes.math, nodes.math_block)):
        return spoken(node.astext()) + " "
    if isinstance(node, nodes.literal_block):
        return node.astext() + " " if node.get("language") == "cpp" else ""
    if isinstance(node, nodes.Text):
        return node.astext()
    return "".join(map(text_of, node.children)) + ("" if isinstance(node, nodes.Inline) else " ")


def write(app, error):
    if error is not None or app.builder.format != "html":
        return
    entries = []
    # the words of the slides are those of the chapters
    for name in sorted(app.env.found_docs - set(slides.NAMES)):
        tree, page = app.env.get_doctree(name), ""
        for section in tree.findall(nodes.section):
            title = section.next_node(nodes.title).astext()
            page = page or title
            if title in ("Run it", "The sources"):  # names of commands and files
                continue
            text = re.sub(r"\s+", " ", "".join(map(text_of, section.children))).strip()
            entries.append([name, page, "" if title == page else title, section["ids"][0], text])
    packed = zipped(json.dumps(entries, ensure_ascii=False).encode())
    script(Path(app.outdir) / "_static/search_data.js", "ANTILOCK_SECTIONS", packed=packed)


def setup(app):
    app.connect("builder-inited", lambda app: setattr(app.builder, "search", False))
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
