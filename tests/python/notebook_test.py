"""The notebook of the how-to runs in a kernel of Jupyter, and prints what the page shows."""
import sys
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat", reason="Debian: python3-nbformat (.ci/install python)")
nbclient = pytest.importorskip("nbclient", reason="Debian: python3-nbclient (.ci/install python)")
pytest.importorskip("ipykernel", reason="Debian: python3-ipykernel (.ci/install python)")

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tutorials/book"))
from notebook import PAGE, blocks, text_of  # noqa: E402


def printed(cell):
    return "".join(output.text for output in cell.outputs if output.output_type == "stream")


def test_the_notebook_of_the_page_prints_what_the_page_shows():
    page = PAGE.read_text(encoding="utf-8")
    book = nbformat.reads(text_of(page), as_version=4)
    nbformat.validate(book)
    nbclient.NotebookClient(book, timeout=60, kernel_name="python3").execute()
    shown = [text for kind, text in blocks(page) if kind == "console"]
    code = [cell for cell in book.cells if cell.cell_type == "code"]
    assert [text for text in map(printed, code) if text] == shown
    assert len(shown) == 7


def test_a_cell_has_no_link_and_no_block_of_code():
    for cell in nbformat.reads(text_of(PAGE.read_text(encoding="utf-8")), as_version=4).cells:
        assert "](" not in cell.source or cell.cell_type == "code"
        assert "```python" not in cell.source
