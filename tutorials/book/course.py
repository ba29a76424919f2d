#!/usr/bin/python3
"""The parts of the book (course.toml), and how many minutes each chapter takes.

Run: tutorials/book/course.py            prints the parts, their chapters and the minutes
     tutorials/book/course.py --write    sorts the chapters of tutorials/README.md by the table
     tutorials/book/course.py --check    exit status 1 if README has another order, or another time by more than 10 %
"""
import re
import sys
import textwrap
import tomllib
from pathlib import Path

from literate import BookError, chunks, needs, pages_of, runs, without_marks

TUTORIALS = Path(__file__).resolve().parents[1]
TABLE = "tutorials/book/course.toml"
KEYS = {"title": str, "kind": str, "about": str, "chapters": list}
KINDS = ("course", "track", "appendix")

# The minutes of a chapter. The constants are fitted to measured times of work with pencil and paper on chapters 00 to
# 33: within 17 minutes per chapter on average, and within 6 % for the sums (21.6 hours to 16, 19.6 hours from 17 on).
WORDS_PER_MINUTE = 50  # words outside of formulas
LINES_PER_MINUTE = 10  # lines of code that are not empty
MINUTES_PER_FORMULA = 0.3  # a formula within a line
MINUTES_PER_DISPLAY = 3  # a formula on a line of its own: the reader derives it
MINUTES_PER_RUN = 2  # a line `Run:`, which is predicted and then compared


def minutes(lines):
    """How long a reader takes for the lines of a page, rounded to 5 minutes."""
    prose, code = [], 0
    for kind, block in chunks(without_marks(lines)):
        if kind == "prose":
            prose += block
        else:
            code += sum(1 for line in block if line.strip() and not line.startswith(("#include", "using ")))
    prose, commands = runs(prose)
    text = "\n".join(line for line in prose if not line.startswith(":"))
    text = text.partition("## Further reading")[0]
    text = re.sub(r"\]\([^)]*\)", "]", text)  # the target of a link is not read
    text, displays = re.subn(r"\$\$.*?\$\$", " ", text, flags=re.S)
    text, formulas = re.subn(r"\$[^$]+\$", " ", text)
    words = len(re.findall(r"[A-Za-z][\w'-]*", text))
    total = (words / WORDS_PER_MINUTE + code / LINES_PER_MINUTE + MINUTES_PER_FORMULA * formulas +
             MINUTES_PER_DISPLAY * displays + MINUTES_PER_RUN * len(commands))
    return max(5, 5 * round(total / 5))


def title_of(lines):
    """The title of a page."""
    return next(line.removeprefix("// # ") for line in lines if line.startswith("// # "))


def needed(lines):
    """The numbers of the chapters that the paragraph `Needs:` of a page names."""
    prose = [line for kind, block in chunks(lines) if kind == "prose" for line in block]
    return re.findall(r"\[(\d\d)\]\(", " ".join(needs(prose)[1]))


def fault(part):
    """The fault of a part of the table, as text, or None."""
    for key, kind in KEYS.items():
        if not isinstance(part.get(key), kind) or not part[key]:
            return f"key {key} is missing, empty or of another type"
    unknown = sorted(part.keys() - KEYS.keys())
    if unknown:
        return f"unknown key {unknown[0]}; accepted: {', '.join(KEYS)}"
    if part["kind"] not in KINDS:
        return f"kind {part['kind']} is unknown; accepted: {', '.join(KINDS)}"
    return None


class Part:
    """One part of the book: its chapters in their order, the pages of these, their minutes, and
    what it needs of other parts. A chapter has one page, unless a line `:page:` begins a second
    one."""

    def __init__(self, row):
        self.title, self.kind, self.about, self.chapters = row["title"], row["kind"], row["about"], row["chapters"]

    def measure(self, book, others):
        """Takes its pages from those of the book. `others` are all parts."""
        placed = {name for part in others for name in part.chapters}
        pages = {part: {name: lines for place in part.chapters for name, (chapter, lines) in book.items()
                        if name == place or (chapter == place and name not in placed)}
                 for part in others}
        self.pages = list(pages[self])
        # of a second page that stands here: its chapter and its title
        self.second = {name: (book[name][0], title_of(pages[self][name]))
                       for name in self.chapters if book[name][0] != name}
        self.minutes = {name: minutes(lines) for name, lines in pages[self].items()}
        self.total = sum(self.minutes.values())
        known = {name[:2] for part in others if part is self or part.kind == "course" for name in part.chapters}
        needs_of = {name: needed(lines) for part in others for name, lines in pages[part].items()}
        own = {name[:2] for name in self.chapters}
        self.needs = sorted({number for name in self.pages for number in needs_of[name]} - known)
        others_of = {name[:2] for name in needs_of if own & set(needs_of[name])}
        self.needed_by = sorted(others_of - own)

    def hours(self):
        """The hours of the part, in words."""
        return f"{round(self.total / 60)} hours"

    def takes(self):
        """The time of the part, in words."""
        if self.kind == "course":
            return f"some {self.hours()}"
        return f"about {self.total if self.total < 100 else 10 * round(self.total / 10)} minutes"

    def relation(self):
        """What the part needs, and which chapters need it, as one or two sentences."""
        if self.kind == "course":
            return "It needs no other chapter."
        def named(numbers):
            return ("chapter " if len(numbers) == 1 else "chapters ") + ", ".join(numbers)
        asked = "It needs the course" + (f" and {named(self.needs)}." if self.needs else ".")
        if not self.needed_by:
            return asked + " Nothing later needs it."
        verb = "needs" if len(self.needed_by) == 1 else "need"
        return f"{asked} {named(self.needed_by).capitalize()} {verb} a part of it."


def read(folder=TUTORIALS):
    """The parts of the book, measured. Throws BookError if the table is wrong, or if the course needs another chapter."""
    try:
        table = tomllib.loads((folder / "book/course.toml").read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise BookError(f"{TABLE}: {error}") from error
    rows = table.pop("part", None)
    if table or not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise BookError(f"{TABLE}: accepted: one [[part]] per part, nothing else")
    for row in rows:
        wrong = fault(row)
        if wrong:
            raise BookError(f"{TABLE}: part {row.get('title', 'without a title')}: {wrong}")
    parts = [Part(row) for row in rows]
    placed = [name for part in parts for name in part.chapters]
    there = sorted(path.name for path in folder.glob("[0-9][0-9]_*") if (path / f"{path.name}.cpp").is_file())
    book = {name: (chapter, lines) for chapter in there
            for name, lines in pages_of(folder / chapter / f"{chapter}.cpp").items()}
    for name in book:
        if placed.count(name) > 1 or (name in there and name not in placed):
            raise BookError(f"{TABLE}: {name} stands in it {placed.count(name)} times; accepted: once, as a line in `chapters` of one part")
    for name in placed:
        if name not in book:
            raise BookError(f"{TABLE}: there is no chapter {name}")
    for part in parts:
        part.measure(book, parts)
        if part.kind == "course" and part.needs:
            raise BookError(f"{TABLE}: the course needs chapter {part.needs[0]}, which is none of its chapters")
    return parts


def sorted_readme(text, parts):
    """README with the list of chapters in the order of the parts. The sentences on the chapters stay as they are."""
    head, found, rest = text.partition("## All chapters\n")
    section, following, rest = rest.partition("\n## Guides\n")
    if not found or not following:
        raise BookError("tutorials/README.md: no section \"All chapters\" before \"Guides\"")
    intro = section.partition("### ")[0].strip()
    entry = r"(?ms)^- \[\d\d [^\n]*?\]\((\w+)/.*?(?=^- |^#|\n\n|\Z)"
    entries = {match[1]: match[0].rstrip() for match in re.finditer(entry, section)}
    lines = ["", intro, ""]
    for part in parts:
        title = f"{part.title}: {part.takes()}" if part.kind == "course" else part.title
        time = "" if part.kind == "course" else f"{part.takes().capitalize()}. "
        lines += [f"### {title}", "", *textwrap.wrap(f"{part.about} {time}{part.relation()}", width=132), ""]
        for name in part.chapters:
            if name not in entries and name in part.second:
                chapter, title = part.second[name]
                lines.append(f"- [{name[:2]}, second page: {title}]({chapter}/{chapter}.cpp)")
                continue
            if name not in entries:
                raise BookError(f"tutorials/README.md: no entry for {name} under \"All chapters\"")
            lines.append(entries[name])
        lines.append("")
    return head + found + "\n".join(lines) + following + rest


def times(text):
    """The text in words without its times, and the times in hours or minutes."""
    time = r"([\d.]+)\s+(?=hours|minutes)"
    return " ".join(re.sub(time, "", text).split()), [float(number) for number in re.findall(time, text)]


def main(arguments):
    parts, readme = read(), TUTORIALS / "README.md"
    text = readme.read_text()
    match arguments:
        case []:
            for part in parts:
                print(f"{part.title}: {part.takes()}. {part.relation()}")
                for name in part.pages:
                    print(f"  {name}  {part.minutes[name]}")
        case ["--write"]:
            readme.write_text(sorted_readme(text, parts))
        case ["--check"]:
            (words, printed), (wanted, measured) = times(text), times(sorted_readme(text, parts))
            if words != wanted or any(abs(a - b) > 0.1 * b for a, b in zip(printed, measured)):
                raise BookError("tutorials/README.md is not sorted by course.toml, or its times are off by more than 10 %; "
                                "tutorials/book/course.py --write mends both")
        case _:
            raise BookError("accepted: nothing, --write or --check")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except BookError as error:
        sys.exit(f"course: {error}")
