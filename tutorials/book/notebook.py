#!/usr/bin/python3
"""The how-to for Python as a Jupyter notebook, so that a reader can change its cells.

Run: notebook.py > howto_python.ipynb

Prose becomes cells of Markdown, and each block of Python becomes a cell of code. The blocks that
show the output of a program are left out, because the notebook prints it. Links are left out as
well: a notebook is read in any folder.
"""
import json
import re
import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parents[1] / "guides/howto_python.md"
BLOCK = re.compile(r"^```(python|console)\n(.*?)^```\n", re.S | re.M)
LINK = re.compile(r"(?<!!)\[([^\]]+)\]\([^)\s]+\)")


def cell(kind, number, text):
    """A cell of version 4.5 of the format. Its id is its place in the notebook."""
    own = {"execution_count": None, "outputs": []} if kind == "code" else {}
    lines = text.strip("\n").splitlines(keepends=True)
    return {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": lines, **own}


def blocks(page):
    """("markdown" | "python" | "console", text) in the order of the page."""
    parts = BLOCK.split(page)
    yield "markdown", parts[0]
    for kind, text, prose in zip(parts[1::3], parts[2::3], parts[3::3]):
        yield kind, text
        yield "markdown", prose


def notebook(page):
    """The notebook of a page of Markdown, without outputs."""
    shown = [(kind, text) for kind, text in blocks(page) if kind != "console" and text.strip()]
    cells = [cell("code", number, text) if kind == "python" else
             cell("markdown", number, LINK.sub(r"\1", text))
             for number, (kind, text) in enumerate(shown)]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
            "nbformat": 4, "nbformat_minor": 5}


def text_of(page):
    """The file of the notebook."""
    return json.dumps(notebook(page), ensure_ascii=False, indent=1) + "\n"


if __name__ == "__main__":
    sys.stdout.write(text_of(PAGE.read_text(encoding="utf-8")))
