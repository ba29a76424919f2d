#!/usr/bin/python3
"""The one reader of figures/table.toml: checks the table, and prints it for bash and for CMake.

Run: figures/table.py rows          a line for each picture: image, figure, chapters, freefem,
                                    caption, every word of render; ASCII's unit separator between
     figures/table.py rows IMAGE    that line alone
     figures/table.py fixtures      IMAGE CHAPTER... for each picture that is drawn from chapters
                                    alone, and not from the results of freefem/compare
"""
import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TABLE = ROOT / "figures/table.toml"
SEPARATOR = "\x1f"
REQUIRED = {"image": str, "chapters": list, "render": list, "caption": str}
KEYS = REQUIRED | {"figure": int, "freefem": str}
KINDS = {str: "text", int: "integer", list: "array of texts"}


class TableError(Exception):
    """A fault of the table: one line that names the file, the picture and the fault."""


def fault(row, before):
    """The fault of a row, as text, or None. `before` holds the rows above it."""
    for key in REQUIRED:
        if key not in row:
            return f"no key {key}"
    for key, value in row.items():
        if key not in KEYS:
            return f"unknown key {key}; accepted: {', '.join(KEYS)}"
        if type(value) is not KEYS[key]:
            return f"{key} is no {KINDS[KEYS[key]]}"
        if KEYS[key] is int:
            continue
        words = value if KEYS[key] is list else [value]
        if not words or not all(isinstance(word, str) and word.strip() for word in words):
            return f"{key} is empty or holds an empty text"
        if not all(word.isprintable() for word in words):
            return f"{key} holds a tab, a line break or another control character"
    if not re.fullmatch(r"\w+", row["image"]):
        return "image holds more than letters, digits and _"
    for key in ("image", "figure"):
        if key in row and any(other.get(key) == row[key] for other in before):
            return f"a second row of {key} {row[key]}"
    for chapter in row["chapters"]:
        if not (ROOT / f"tutorials/{chapter}/{chapter}.cpp").is_file():
            return f"unknown chapter {chapter}: there is no tutorials/{chapter}/{chapter}.cpp"
    if "freefem" in row and not (ROOT / f"freefem/{row['freefem']}.edp").is_file():
        return f"unknown script: there is no freefem/{row['freefem']}.edp"
    if not row["caption"].endswith("."):
        return "the caption does not end with a full stop"
    return None


def read():
    """The rows of the table, in its order; the words of a caption with single spaces between."""
    try:
        table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise TableError(f"figures/table.toml: {error}") from error
    rows = table.pop("picture", None)
    if table or not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise TableError("figures/table.toml: accepted: one [[picture]] per picture, nothing else")
    for number, row in enumerate(rows):
        if isinstance(row.get("caption"), str):
            row["caption"] = " ".join(row["caption"].split())
        wrong = fault(row, rows[:number])
        if wrong:
            name = row.get("image", "no image")
            raise TableError(f"figures/table.toml: picture {number + 1} ({name}): {wrong}")
    return rows


def line(row):
    chapters = " ".join(row["chapters"])
    fields = [row["image"], str(row.get("figure", "")), chapters, row.get("freefem", "")]
    return SEPARATOR.join([*fields, row["caption"], *row["render"]])


def from_freefem(row):
    return any(word.startswith("results/freefem/") for word in row["render"])


def main(arguments):
    sys.stdout.reconfigure(encoding="utf-8")
    match arguments:
        case ["rows"]:
            lines = [line(row) for row in read()]
        case ["rows", image]:
            lines = [line(row) for row in read() if row["image"] == image]
            if not lines:
                raise TableError(f"figures/table.toml: no image {image}")
        case ["fixtures"]:
            rows = [row for row in read() if not from_freefem(row)]
            lines = [" ".join([row["image"], *row["chapters"]]) for row in rows]
        case _:
            sys.exit("figures/table.py: accepted: rows, rows IMAGE or fixtures")
    print("\n".join(lines))


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except TableError as error:
        sys.exit(str(error))
