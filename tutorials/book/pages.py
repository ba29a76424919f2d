#!/usr/bin/python3
"""Writes the Markdown of every page of the book, and its pictures. Run: pages.py FOLDER [--without-runs | --draft]

--without-runs leaves out what a run would have printed, where it has not run; --draft, for who writes a chapter, says what
is wrong and goes on.
"""
import json
import os
import re
import subprocess
import sys
import zipfile
from collections import defaultdict
from functools import partial
from pathlib import Path

from PIL import Image

import slides
from course import read as read_course
from literate import (PLACE, STILLS, BookError, Page, answers_on_paper, button, fence, folded,
                      live_figure, pages_of, runs_in_the_page, signs, with_exercises,
                      with_predictions, without_answer)
from katex import TAG
from library import Library
from links import linked, term_anchor
from notebook import text_of as notebook_of
from runs import expected

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "figures"))
from table import TableError, read as read_table  # noqa: E402

EXTRA = ["howto_scene", "howto_matrices", "howto_python", "dataset", "uniform_rate", "order_two", "locking_loss", "verification", "errata", "glossary", "notation", "bibliography"]
TEACHING = ["teaching", "lab", *slides.NAMES, "problem_sheets", "answer_book", "exam"]
WIDTH, HEIGHT = 900, 760  # at most, in pixels; a page shows a picture 740 wide and 480 high at most (style.css)


class Book:
    def __init__(self, out, draft=False, without_runs=False):
        self.out, self.draft, self.without_runs = out, draft, without_runs
        self.sources = sorted(path for path in (ROOT / "tutorials").glob("[0-9][0-9]_*/[0-9][0-9]_*.cpp"))
        self.names = [name for path in self.sources for name in pages_of(path)]
        self.parts = read_course(ROOT / "tutorials")
        self.table = read_table()
        self.library = Library(ROOT / "lib")
        self.pages, self.equations = {}, {}  # by tag: the chapter that has the equation first
        self.takes = defaultdict(lambda: "seconds", expected())
        # a term with a qualification, as "gap (of an obstacle)", is a word that the course uses in other senses too
        rows = re.findall(r"^\| ([^|]+?) \| [^|]+ \| [\d, ]+ \|$", (ROOT / "tutorials/guides/glossary.md").read_text(), re.M)
        self.terms = [term for row in rows for term in [re.sub(r" \([A-Z]+\)$", "", row)] if not re.search(r"[(,/]", term)]

    def complain(self, what):
        if not self.draft:
            raise BookError(what)
        print(f"draft: {what}", file=sys.stderr)

    def first_of(self, number):
        """The chapter of a number; where two share it, the first."""
        return next((name for name in self.names if name.startswith(number + "_")), None)

    # ---- links

    def link(self, target, where):
        """The page behind a link of the sources; None: a file of the repository that is no page."""
        target, _, anchor = target.partition("#")
        anchor = f"#{anchor}" if anchor else ""
        if not target or re.match(r"[a-z]+:", target):
            return target + anchor
        path = Path(os.path.normpath(where / target))
        if path.suffix in (".cpp", ".edp") and path.stem in self.names and path.parent.name in (path.stem, "freefem"):
            return path.stem + ".md" + anchor
        if path.parent.name in ("guides", "book") and path.suffix in (".md", ".html") and path.stem in EXTRA + TEACHING + self.names:
            return path.stem + ".md" + anchor
        if path == ROOT / "tutorials/README.md":
            return "theory.md"
        if path == ROOT / "tutorials/book/playground.md":
            return "playground.md" + anchor
        if path == ROOT / "figures/README.md":
            return "gallery.md"
        if not path.exists():
            self.complain(f"{where.relative_to(ROOT)}: unknown link {target}")
        if path.suffix == ".hpp" and (ROOT / "lib/antilock") in path.parents:
            return self.library.page(path)
        if path.suffix == ".png" and path.parent == ROOT / "figures/images":
            return self.picture(path.stem)
        return None

    def linked(self, lines, where, spell=lambda text: text, terms=()):
        def complain(what):
            self.complain(f"{where.relative_to(ROOT)}: {what}")
        return linked(lines, lambda target: self.link(target, where),
                      lambda number: self.first_of(number) or complain(f"chapter {number} does not exist"), self.equations,
                      complain, spell, terms)

    # ---- pictures

    def picture(self, name):
        """The WebP of figures/images; made anew where the PNG is newer."""
        source, target = ROOT / f"figures/images/{name}.png", self.out / f"images/{name}.webp"
        if not source.exists():
            self.complain(f"figures/images/{name}.png is missing; figures/reproduce {name} makes it")
            return None
        if not target.exists() or target.stat().st_mtime < source.stat().st_mtime:
            target.parent.mkdir(parents=True, exist_ok=True)
            image = Image.open(source).convert("RGB")
            image.thumbnail((WIDTH, HEIGHT), Image.LANCZOS)
            image.save(target, "WEBP", quality=40, method=6)
        return f"images/{name}.webp"

    def figure(self, row, eager=False):
        path = self.picture(row["image"])
        if path is None:
            return []
        title = f"**Figure {row['figure']} of the paper.** " if "figure" in row else ""
        alt = json.dumps(row["caption"], ensure_ascii=False)  # a quoted text of YAML
        return [f"```{{figure}} {path}", f":alt: {alt}", ":figclass: picture", f":target: _images/{row['image']}.webp",
                *([] if eager else [":class: lazy"]), "", title + signs(row["caption"]), "```", ""]

    # ---- pages

    def write(self, name, lines):
        text = "\n".join(lines) + "\n"
        path = self.out / f"{name}.md"
        if not path.exists() or path.read_text() != text:
            path.write_text(text)

    def log(self, stem):
        """What the program printed: its lines, and the verdicts among them. None where it has not run."""
        path = ROOT / f"results/logs/{stem}.log"
        if not path.exists():
            if not self.without_runs:
                self.complain(f"results/logs/{stem}.log is missing; figures/reproduce writes it")
            return None
        text = path.read_text().replace(f"{ROOT}/", "")
        return [line.rstrip() for line in re.sub(r"\r[^\n]*", "", text).splitlines()]

    def output(self, stem, title=""):
        """What the program printed: the table below the line that begins with `title`, or everything, the verdicts first."""
        lines = self.log(stem)
        if lines is None:
            return []
        if title:
            start = next((i for i, line in enumerate(lines) if line.strip().startswith(title)), None)
            if start is None:
                self.complain(f"{stem}.cpp: :output: {title}: no line of results/logs/{stem}.log begins so")
                return []
            end = next((i for i in range(start, len(lines)) if not lines[i]), len(lines))
            return fence("text", lines[start:end])
        verdicts = [line for line in lines if line.startswith("VERDICT")]
        out = []
        if verdicts:
            out += ["```{list-table}", ":class: verdicts", ":widths: 12 88", ""]
            for line in verdicts:
                holds, what = line.removeprefix("VERDICT ").split(": ", 1)
                out += [f"* - **{holds}**", f"  - {self.escaped(what)}"]
            out += ["```", ""]
        rest = [line for line in lines if not line.startswith("VERDICT")]
        shown = fence("text", rest)
        return out + (folded(f"All {len(rest)} lines", shown, "printed") if len(rest) > 60 else shown)

    @staticmethod
    def escaped(text):
        return re.sub(r"([\\`*_\[\]<>$^|#])", r"\\\1", text)

    def pictures_of(self, stem):
        """The pictures of a page: those of its chapter without those that another page places.
        A picture that no line places stands on the first page."""
        source, pages = self.pages[stem].source, self.pages.items()
        rows = [row for row in self.table if source.stem in row["chapters"]]
        beside = [name for name, page in pages if page.source == source and name != stem]
        elsewhere = {image for name in beside for image in self.pages[name].placed()}
        here = self.pages[stem].placed() if stem != source.stem else None
        return [row for row in rows if row["image"] not in elsewhere and
                (here is None or row["image"] in here)]

    def placed(self, lines, stem):
        """The page with the pictures and the output that its lines place: (lines, names of these pictures, all of the output?)."""
        program = self.pages[stem].source.stem
        out, names, whole, fenced = [], [], False, False
        for line in lines:
            fenced ^= line.startswith("```")
            place = None if fenced else PLACE.match(line)
            if not place:
                out.append(line)
            elif place[1] == "output":
                whole |= not place[2]
                out += self.output(program, place[2])
            else:
                rows = [self.shot(stem, name, names) for name in place[2].split()]
                pictures = [line for row in rows if row for line in self.figure(row, eager=not names)]
                names += place[2].split()
                out += [":::{container} pictures", *pictures, ":::", ""] if len(rows) > 1 else pictures
        return out, names, whole

    def shot(self, stem, name, before):
        row = next((row for row in self.table if row["image"] == name), None)
        if row is None:
            self.complain(f"{stem}.cpp: :figure: {name}: no picture of figures/table.toml")
        if name in before:
            self.complain(f"{stem}.cpp: :figure: {name}: it stands on the page already")
        return row

    def place(self, stem):
        """The part of a chapter and its minutes, as one line."""
        part = next(part for part in self.parts if stem in part.pages)
        if part.kind == "course" and not self.pages[stem].objectives:
            self.complain(f"{stem}.cpp: no paragraph \"**Afterwards you can** ...\"; each chapter of the course has one")
        at = part.title
        if part.kind == "course":
            at += f", chapter {part.pages.index(stem) + 1} of {len(part.pages)}"
        return f"**{at}.** About {part.minutes[stem]} minutes."

    def relations(self, stem):
        """The place of the chapter, its objectives and what it needs, in its own words, and where it leads to."""
        page = self.pages[stem]
        leads = [name for name in self.names if stem[:2] in self.pages[name].needed() and name != stem]
        leads = leads if stem == page.source.stem else []  # a number is that of the first page
        def titled(found):
            return f"[{found[1]} {self.pages[found[3]].title}]({found[2]})" if found[3] in self.pages else found[0]
        out = [self.place(stem), *page.objectives, ""]
        out += [re.sub(r"\[(\d\d)\]\(((?:\.\./)?(\w+)/\3\.cpp)\)", titled, line) for line in page.needs]
        if leads:
            out.append("Leads to: " + ", ".join(f"[{name[:2]} {self.pages[name].title}](../{name}/{name}.cpp)" for name in leads) + ".")
        return [":::{container} relations", *self.linked(out, page.source.parent), ":::", ""]

    def chapter(self, stem):
        """The first picture that no line places stands on top. Where a page places pictures, it places all others of its own."""
        page = self.pages[stem]
        source = page.source
        lines = with_predictions(page.body, stem)
        body, names, output = self.placed(self.linked(lines, source.parent, terms=self.terms), stem)
        shots = [row for row in self.pictures_of(stem) if row["image"] not in names]
        if names:
            # one of two chapters may leave their picture to the other
            shots = [row for row in shots if row["chapters"] == [source.stem]]
        if names and len(shots) > 1:
            self.complain(f"{stem}.cpp: no line places the picture {shots[1]['image']}; accepted: :figure: {shots[1]['image']}")
        out = [f"# {stem[:2]} {page.title}", "", *self.relations(stem)]
        commands, here = [command for command, _ in page.runs], runs_in_the_page(source.read_text())
        missing = [command for command in commands if here and command not in self.takes]
        if missing:
            self.complain(f"{stem}.cpp: {missing[0]} has no row in wasm/runs.csv; tutorials/book/wasm/measure build/bin writes it")
        if here and commands:
            out += self.console(source.stem, commands[0])
            body, commands = with_exercises(body, commands, self.takes)
        elif commands:
            out += ["This program asks for PETSc and several processes: it does not run in a page.", ""]
        out += self.figure(shots[0], eager=True) if shots else []
        out += body
        answers = answers_on_paper(source.parent / "answers.hpp", page.body)
        for number in without_answer(page.body, [command for command, _ in page.runs], answers):
            self.complain(f"{stem}.cpp: exercise {number} has no answer: no line `Run: {stem} --exercise {number}`, no **{number}.** in answers.hpp")
        if answers:
            out += folded("Answers on paper", self.linked(answers, source.parent), "answers")
        if commands:
            out += ["## Run it", "", *(["| | command | what it does |", "|---|---|---|"] if here else ["| command | what it does |", "|---|---|"])]
            out += [(f"| {button(command, self.takes)} " if here else "") + f"| `{command}` | {what} |" for command, what in page.runs if command in commands]
            out.append("")
        for shot in shots[1:]:
            out += self.figure(shot)
        printed = [] if output else self.output(source.stem)
        out += ["## What it prints", "", *printed] if printed else []
        out += ["## The sources", ""]
        twin = ROOT / f"freefem/{stem}.edp"
        if twin.exists() and not page.twin:
            whole = twin.read_text().splitlines()
            out += folded(f"The FreeFEM twin as it is: freefem/{stem}.edp, {len(whole)} lines", fence("freefem", whole), "twin")
        out += ["To keep: {download}`all programs of the course, with their twins <sources.zip>`; this one is "
                f"`{source.relative_to(ROOT)}`" + (f", its twin `freefem/{twin.name}`" if twin.exists() else "") + ".", ""]
        self.write(stem, out)

    def console(self, stem, command):
        """The button on top, with the seconds to expect."""
        return ["", f'<div id="run" data-program="{stem}"><p class="run-line">{button(command, self.takes, "Run this chapter here")}: '
                f'its own program, with nothing to install</p></div>', ""]

    def playground(self):
        """run_scene in a page: every scene that does not ask for PETSc is a start."""
        folder = ROOT / "tutorials/scenes"
        scenes = {path.stem: path.read_text() for path in sorted(folder.glob("*.toml")) if '"petsc"' not in path.read_text()}
        meshes = {path.name: path.read_text() for path in sorted(folder.glob("*.msh"))}
        data = json.dumps({"scenes": scenes, "meshes": meshes}).replace("</", "<\\/")
        text = (ROOT / "tutorials/book/playground.md").read_text()
        self.write("playground", self.linked(text.splitlines(), ROOT / "tutorials/book") +
                   ["", f'<script type="application/json" id="scenes">{data}</script>', ""])

    def sources_to_keep(self):
        """What the chapters are made of, in one file for all of them: on every page a copy of its own weighs more."""
        with zipfile.ZipFile(self.out / "sources.zip", "w", zipfile.ZIP_DEFLATED, compresslevel=9) as kept:
            for pattern in ("tutorials/[0-9][0-9]_*/*.[ch]pp", "tutorials/course/*.[ch]pp", "lib/programs/**/*.[ch]pp", "tutorials/scenes/*.toml", "tutorials/scenes/*.msh", "freefem/*.edp"):
                for path in sorted(ROOT.glob(pattern)):
                    kept.writestr(zipfile.ZipInfo(str(path.relative_to(ROOT))), path.read_bytes(), zipfile.ZIP_DEFLATED)

    def shown(self, lecture, name):
        """The picture of a slide: its path, its caption, its width over its height."""
        row = next((row for row in self.table if row["image"] == name), None)
        if row is None:
            self.complain(f"{lecture}.md: :figure: {name}: no picture of figures/table.toml")
            return None
        path = self.picture(name)
        if path is None:
            return None
        with Image.open(ROOT / f"figures/images/{name}.png") as image:
            return path, row["caption"], image.width / image.height

    def notebook(self, page):
        """The notebook of the how-to for Python, and the lines that link to it."""
        (self.out / "howto_python.ipynb").write_text(notebook_of(page))
        return ["", "To keep: {download}`this page as a Jupyter notebook <howto_python.ipynb>`, "
                "whose cells you can change.", ""]

    def theory(self):
        text = (ROOT / "tutorials/README.md").read_text()
        section = re.search(r"## The theory as experiments\n(.*?)(?=\n## |\Z)", text, re.S)
        if not section:
            raise BookError("tutorials/README.md: no section \"The theory as experiments\"")
        self.write("theory", ["# The theory as experiments", "", *self.linked(re.sub(r"\[(\d\d)_\w+\]\(", r"[\1](", section[1]).splitlines(), ROOT / "tutorials", signs)])

    def gallery(self):
        out = ["# Gallery", "", "Every picture, and the chapter that makes it.", ""]
        for row in self.table:
            chapters = [f"[{self.pages[name].title}]({name}.md)" for name in row["chapters"] if name in self.pages]
            picture = self.figure(row)
            if not picture:
                continue
            picture[-3] += (" From " + ", ".join(chapters) + ".") if chapters else ""
            out += picture
        self.write("gallery", out)

    def glossary_line(self, line):
        """A row of the glossary: its term is linked to, its last column names chapters by number."""
        def chapter(found):
            name = self.first_of(found[0])
            return f"[{found[0]}]({name}.md)" if name else found[0]
        def numbers(found):
            return "| " + re.sub(r"\d\d", chapter, found[1]) + " |"
        def place(found):
            return f'| <span id="{term_anchor(found[1])}"></span>{found[1]}' if found[1] in self.terms else found[0]
        return re.sub(r"\| ([\d, ]+) \|$", numbers, re.sub(r"^\| ([^|]+?)(?= \([A-Z]+\) \|| \|)", place, line))

    def contents(self, part):
        """A part in the table of contents: what it is for, its time, and a row for each chapter."""
        rows = [f"| [{name[:2]} {self.pages[name].title}]({name}.md) | {part.minutes[name]} |"
                for name in part.pages]
        head = f"{part.title}: {part.takes()}" if part.kind == "course" else part.title
        time = "" if part.kind == "course" else f"{part.takes().capitalize()}. "
        relation = re.sub(r"\b\d\d\b(?! minutes)", lambda found: f"[{found[0]}]({self.first_of(found[0])}.md)", part.relation())
        return [f"## {head}", "", f"{part.about} {time}{relation}", "", "| chapter | minutes |", "|---|---|", *rows, "",
                "```{toctree}", ":hidden:", f":caption: {part.title}", "",
                *(f"{name[:2]} {self.pages[name].title} <{name}>" for name in part.pages),
                "```", ""]

    def index(self):
        text = "\n".join(self.linked((ROOT / "tutorials/book/index.md").read_text().splitlines(), ROOT / "tutorials/book"))
        contents = [line for part in self.parts for line in self.contents(part)]
        more = ["playground", "theory", "gallery", *(name for name in EXTRA if (self.out / f"{name}.md").exists()), "library"]
        contents += ["## For teachers", "", "```{toctree}", ":caption: For teachers", ":maxdepth: 1", "", *TEACHING, "```", ""]
        contents += ["## To look up", "", "```{toctree}", ":caption: To look up", ":maxdepth: 1", "", *more, "```"]
        live = "\n".join(live_figure("mesh=unstructured")[1])
        self.write("index", text.replace(":live:", live).replace(":chapters:", "\n".join(contents)).splitlines())

    def make(self):
        self.out.mkdir(parents=True, exist_ok=True)
        for source in self.sources:
            for name, lines in pages_of(source).items():
                page = Page(source, lines, ROOT / f"freefem/{name}.edp", self.draft)
                self.pages[name] = page
                if name != source.stem:  # a second page has the button of the first one
                    page.runs = self.pages[source.stem].runs[:1] + page.runs
                for tag in TAG.findall("\n".join(page.body)):
                    self.equations.setdefault(tag, name)
        for still in STILLS.values():
            self.picture(still)
        for name in self.names:
            self.chapter(name)
        for name in EXTRA + TEACHING:
            page = (ROOT / f"tutorials/guides/{name}.md").read_text()
            lines = page.splitlines()
            if name == "glossary":
                lines = list(map(self.glossary_line, lines))
            if name in slides.NAMES:
                lines = slides.with_pictures(lines, partial(self.shown, name))
            more = self.notebook(page) if name == "howto_python" else []
            self.write(name, self.linked(lines, ROOT / "tutorials/guides", signs) + more)
        self.sources_to_keep()
        self.theory()
        self.playground()
        self.gallery()
        self.library.write(self.write, self.sources)
        self.index()
        self.write("search", (ROOT / "tutorials/book/search.md").read_text().splitlines())
        known = {*self.names, *EXTRA, *TEACHING, "playground", "search", "theory", "gallery", "index", "library", *self.library.page_names()}
        for path in self.out.glob("*.md"):
            if path.stem not in known:
                path.unlink()


if __name__ == "__main__":
    try:
        Book(Path(sys.argv[1]).resolve(), "--draft" in sys.argv[2:], "--without-runs" in sys.argv[2:]).make()
    except (BookError, TableError) as error:
        sys.exit(f"book: {error}")
