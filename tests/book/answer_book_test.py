#!/usr/bin/python3
"""The programs of the answer book print what the page shows below them. Run: answer_book_test.py     exit status 77 without numpy"""
import contextlib
import io
import re
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    print("answer_book_test: python3-numpy is missing")
    sys.exit(77)

PAGE = Path(__file__).resolve().parents[2] / "tutorials/guides/answer_book.md"
blocks = re.findall(r"```(python|console)\n(.*?)```", PAGE.read_text(), re.S)
names, printed, compared = {}, "", 0
for kind, text in blocks:
    if kind == "python":
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(text, names)
        printed = out.getvalue()
    elif printed != text:
        sys.exit(f"answer_book.md shows\n{text}and its program prints\n{printed}")
    else:
        compared += 1
print(f"{compared} programs print what the page shows")
sys.exit(compared != 8)
