"""A tutorial (C++ or FreeFEM with prose in its comments) as Markdown.

- A comment at the margin is prose (Markdown, formulas between dollars); everything else is code.
- An indented comment belongs to the code, unless it begins with a heading (`### Solve`): then it is prose too.
- `### Solve` in the C++ finds `// ### Solve` in the FreeFEM twin, which is folded under it.
- The lines that judge a run are folded: the functions `judge`, and other functions from their
  first claim on.
- `Run: COMMAND    what it does` lines become a table with buttons; includes are folded away.
- `:live: string` places a live figure, `:live: mesh=layered cells=32` the one of P1 and Crouzeix-Raviart with its settings.
- `:figure: NAME ...` places pictures of figures/table.toml, `:output:` what the program printed: pages.py puts them in.
- `:number: ...` is for tests/chapters/numbers, and is left out.
- `:page: NAME` begins another page of the same program.
"""
import html
import re

HEADING = re.compile(r"#{1,4} ")
LIVE = re.compile(r":live:\s*(.*)$")
PLACE = re.compile(r":(live|figure|output):\s*(.*)$")


class BookError(Exception):
    """What stops the build: one line that names the file."""


def chunks(lines):
    """("prose" | "code", lines) in the order of the file."""
    kind, block, in_step, fenced = "code", [], False, False
    for line in lines:
        text = line.strip()
        comment = text.startswith("//")
        body = text[2:].removeprefix(" ")
        if comment and not line[0].isspace():
            new = "prose"
        elif comment and (HEADING.match(body) or (kind == "prose" and in_step)):
            new, in_step = "prose", True
        else:
            new, in_step = "code", False
        if new != kind:
            if any(part.strip() for part in block):
                yield kind, block
            kind, block = new, []
        block.append(body if new == "prose" else line.rstrip())
    if any(part.strip() for part in block):
        yield kind, block


def pages_of(source):
    """The pages of a chapter: {name: its lines}. The first one has the name of the file, and
    `:page: NAME` begins the next."""
    name = source.stem
    found = {name: []}
    for line in source.read_text().splitlines():
        mark = re.match(r"// :page: (\w+)$", line)
        if not mark:
            found[name].append(line)
            continue
        name = mark[1]
        if name in found or name[:3] != source.stem[:3]:
            raise BookError(f"{source.name}: :page: {name}: accepted: a new name that begins "
                            f"with {source.stem[:3]}")
        found[name] = []
    return found


def without_marks(lines):
    """The lines but the marks of tests/chapters/numbers."""
    return [line for line in lines if not line.startswith("// :number: ")]


def dedent(lines):
    while lines and not lines[0].strip():
        lines = lines[1:]
    while lines and not lines[-1].strip():
        lines = lines[:-1]
    margin = min((len(line) - len(line.lstrip()) for line in lines if line.strip()), default=0)
    return [line[margin:] for line in lines]


def fence(language, lines):
    return [f"```{language}", *dedent(lines), "```", ""]


def folded(summary, lines, kind):
    return [f'<details class="{kind}"><summary>{html.escape(summary)}</summary>', "", *lines, "", "</details>", ""]


CLAIM = re.compile(r"\breport\.claim\w*\(")


def function_end(block, start):
    """The index behind the function that is open or begins at `start`: that of its brace at the
    margin, or the end of the code."""
    return next((i + 1 for i in range(start, len(block)) if block[i] == "}"), len(block))


def judges(block, start):
    """Whether a function that judges a run is defined here; a declaration ends with a semicolon."""
    if not re.match(r"void judge\w*\(", block[start]):
        return False
    opening = next((line for line in block[start:] if line.endswith(("{", ";"))), ";")
    return opening.endswith("{")


def first_of_claim(block, at):
    """The line at which the statement of a claim begins, with the comment above it; None inside a
    longer statement."""
    start = at
    while start > 0 and block[start].startswith("   "):
        start -= 1
    if at - start > 3 or not block[start].startswith("  "):
        return None
    while start > 0 and block[start - 1].startswith("  // "):
        start -= 1
    return start


def verdicts(block):
    """The ranges of lines that judge a run: functions `judge`, and others from their first claim."""
    at = 0
    while at < len(block):
        start = at if judges(block, at) else None
        if start is None and CLAIM.search(block[at]):
            start = first_of_claim(block, at)
        if start is None:
            at += 1
            continue
        at = function_end(block, at)
        yield start, at


def code(block):
    """The fences of a program; the lines that judge the run are folded."""
    out, at = [], 0
    for start, end in verdicts(block):
        if any(line.strip() for line in block[at:start]):
            out += fence("cpp", block[at:start])
        summary = f"The verdict: {end - start} lines"
        out += folded(summary, fence("cpp", block[start:end]), "verdict")
        at = end
    return out + (fence("cpp", block[at:]) if any(line.strip() for line in block[at:]) else [])


def step_name(heading):
    """`### Solve: the contact loop` is the step Solve."""
    return re.split(r"[:,.(]", heading.lstrip("# "))[0].strip()


def steps(path):
    """The steps of a program: {name: its lines}."""
    found, name = {}, None
    for line in path.read_text().splitlines() if path.exists() else []:
        heading = re.match(r"\s*// (### .+)", line)
        if heading:
            name = step_name(heading[1])
        if name:
            found.setdefault(name, []).append(line.replace("// ### ", "// "))
    return found


def runs(prose):
    """Takes the `Run:` lines out of the prose: (prose, [(command, what it does)])."""
    found, rest = [], []
    for line in prose:
        run = re.match(r"Run: (\S.*?)(?:  +(.*))?$", line)
        if run:
            found.append((run[1], run[2] or ""))
        else:
            rest.append(line)
    return rest, found


def runs_in_the_page(source):
    """Whether this text of a program asks for no PETSc: wasm/build leaves out the same."""
    return not re.search(r'#include "antilock/distributed/', source)


def options(command):
    """The options of a command; its first word is the program."""
    return command.partition(" ")[2]


def button(command, takes, says="run"):
    """Runs a command in the page, with how long that takes; the script, which can, enables it."""
    return (f'<button type="button" data-run="{html.escape(options(command))}" disabled>{says}</button>'
            f' <span class="takes">{takes[command]}</span>')


def with_exercises(lines, commands, takes):
    """A field for the prediction, and a button, behind each exercise of the list that a command of `commands` answers:
    (lines, the commands that are left)."""
    out, left, number, at = [], dict((options(command), command) for command in commands), None, None
    inside = False

    def close():
        nonlocal at
        command = left.pop(f"--exercise {number}", None) if at is not None else None
        if command:
            out[at] += (' <span class="predict"><input type="text" aria-label="Your prediction" placeholder="your prediction">'
                        f' {button(command, takes)}</span>')
        at = None

    for line in lines:
        if line.startswith("#"):
            close()
            inside = line == "## Exercises"
        item = re.match(r"(\d+)\. ", line) if inside else None
        if item or not line.strip():
            close()
        out.append(line)
        if item:
            number, at = int(item[1]), len(out) - 1
        elif at is not None:
            at = len(out) - 1
    close()
    return out, list(left.values())


def paragraph_end(lines, start):
    """The index behind the paragraph that begins at `start`."""
    at = start
    while at < len(lines) and lines[at].strip() and not PLACE.match(lines[at]):
        at += 1
    return at


def prediction_fields(stem, questions):
    """A field for each question. Without a script it stays hidden; book.js shows it."""
    out = [f'<div class="predictions" data-page="{stem}" hidden>']
    for letter in questions:
        label = f"Your prediction ({letter})" if letter else "Your prediction"
        out.append(f'<p><label><span>{label}</span> <input type="text" data-question="{letter}"'
                   ' autocomplete="off"></label><span class="typed"></span></p>')
    forget = ('<p><button type="button">forget</button> '
              "<span>This browser keeps the text, and shows it beside the answers.</span>"
              "</p></div>")
    return ["", *out, forget, ""]


def with_predictions(lines, stem):
    """A field behind the paragraph `**Predict` for each (a), (b), ... in it, and the place in
    `## What came out` that shows the text again, before the paragraph that answers (a)."""
    start = next((i for i, line in enumerate(lines) if line.startswith("**Predict")), None)
    if start is None:
        return lines
    end = paragraph_end(lines, start)
    marks = re.findall(r"(?<!\S)\(([a-e])\)", " ".join(lines[start:end]))
    questions = []
    for letter in marks:  # a letter out of this order is none of the questions
        if letter == "abcde"[len(questions):][:1]:
            questions.append(letter)
    if "## What came out" not in lines[end:]:
        raise BookError(f'{stem}.cpp: no section "## What came out", which answers the predictions')
    came_out = lines.index("## What came out", end)
    first = r"(?:.* )?\(a\)(?: |$)" if questions else ".*"
    behind = came_out + 1
    answer = next((i for i in range(behind, len(lines)) if re.match(first, lines[i])), behind)
    while answer > behind and lines[answer - 1].strip() and not PLACE.match(lines[answer - 1]):
        answer -= 1
    place = ["", '<div class="predicted" hidden></div>', ""]
    fields = prediction_fields(stem, questions or [""])
    return [*lines[:end], *fields, *lines[end:answer], *place, *lines[answer:]]


def without_answer(lines, commands, paper):
    """The numbers of the exercises in the list that no command answers, and no `**3.**` of the answers on paper."""
    listed = re.findall(r"(?m)^(\d+)\. ", "\n".join(lines).partition("## Exercises")[2])
    answered = [command.rpartition("--exercise ")[2] for command in commands] + re.findall(r"\*\*(\d+)\.\*\*", "\n".join(paper))
    return [number for number in listed if number not in answered]


def paragraph(prose, words):
    """Takes the paragraph that begins with these words out of the prose: (prose, the paragraph)."""
    start = next((i for i, line in enumerate(prose) if line.startswith(words)), None)
    if start is None:
        return prose, []
    end = paragraph_end(prose, start)
    return prose[:start] + prose[end:], prose[start:end]


def needs(prose):
    """Takes the paragraph `Needs: [00](...) (cone), ...` out of the prose: (prose, the paragraph)."""
    return paragraph(prose, "Needs: ")


def answers_on_paper(path, page):
    """The text under `## Answers on paper` in the answers of a chapter, as far as it answers an
    exercise of this page. An answer begins with its number, as `**3.**`."""
    exercises = "\n".join(page).partition("## Exercises")[2]
    listed = re.findall(r"(?m)^(\d+)\. ", exercises)
    out, kept = [], True
    for line in all_answers(path):
        number = re.match(r"\*\*(\d+)\.\*\*", line)
        kept = number[1] in listed if number else kept
        out += [line] if kept else []
    return out


def all_answers(path):
    """The lines under `## Answers on paper` in the answers of a chapter."""
    for kind, block in chunks(path.read_text().splitlines()) if path.exists() else []:
        if kind == "prose" and "## Answers on paper" in block:
            return block[block.index("## Answers on paper") + 1:]
    return []


GREEK = dict(zip("alpha beta gamma delta epsilon eta theta kappa lambda mu pi rho sigma chi "
                 "Gamma Omega Sigma".split(), "αβγδεηθκλμπρσχΓΩΣ"))
SCRIPT = r"(?:\{[^}]*\}|-?\d+(?:\.\d+)?(?!\w)|\([\d/]+\)|-?[A-Za-z0-9]+|[-+](?!\w))"
SCRIPTS = re.compile(rf"((?<![\w\\])(?:[A-Za-z]|{'|'.join(GREEK)})|\||\)|(?<!\w)\d+(?=\^))((?:[_^]{SCRIPT})+)")
RELATIONS = {"->": "→", ">=": "≥", "<=": "≤", "<<": "≪"}


def signs(text):
    """The letters that tables and captions write out, as u_h^epsilon -> u^0 or h^(3/2), set as signs."""
    def one(found):
        scripts = re.findall(rf"([_^])({SCRIPT})", found[2])
        return found[1] + "".join(f"<{tag}>{signs(part.strip('{}()')).replace('-', '−')}</{tag}>"
                                  for kind, part in scripts for tag in ["sub" if kind == "_" else "sup"])
    text = SCRIPTS.sub(one, text)
    text = re.sub(rf"(?<!\w)({'|'.join(GREEK)})(?!\w)", lambda found: GREEK[found[1]], text)
    return re.sub("->|>=|<=|<<", lambda found: RELATIONS[found[0]], text)


class Page:
    """One page of a chapter, in the order of its lines. `source` is the chapter's file."""

    def __init__(self, source, lines, twin, draft):
        self.title, self.lead, self.body, self.runs, self.objectives, self.needs = None, [], [], [], [], []
        self.source, self.lives, self.steps = source, [], set()
        self.twin = steps(twin)
        self.shown = set()
        step = None
        for kind, block in chunks(without_marks(lines)):
            if kind == "code":
                head = next((i for i, line in enumerate(block) if line.strip() and not line.startswith(("#include", "using "))),
                            len(block))
                if any(line.startswith("#include") for line in block[:head]):
                    self.body += folded("Headers", fence("cpp", block[:head]), "headers")
                    block = block[head:]
                self.body += code(block)
                continue
            if self.title is None:
                block = self.header(source, block, draft)
            fenced = False
            for line in block:
                fenced ^= line.startswith("```")
                if HEADING.match(line) and not fenced:
                    self.show_twin(step)
                    step = step_name(line) if line.startswith("### ") else None
                    self.steps.add(step)
                live = None if fenced else LIVE.match(line)
                self.body += self.live(source.name, live[1]) if live else [line]
            self.body.append("")
        self.show_twin(step)
        missing = [name for name in self.twin if name not in self.steps]
        if missing and not draft:
            raise BookError(f"{twin.name}: step \"{missing[0]}\" is none of {source.name}; it has {sorted(s for s in self.steps if s)}")

    def header(self, source, block, draft):
        if not block[0].startswith("# "):
            if not draft:
                raise BookError(f"{source.name}: line 1 is no title; accepted: \"// # Title\"")
            block = ["# " + block[0].split(".")[0], "", *block]
        self.title = block[0][2:].strip()
        if not draft and len(self.title.split()) > 6:
            raise BookError(f"{source.name}: the title has {len(self.title.split())} words; accepted: at most six")
        block, self.runs = runs(block[1:])
        block, self.objectives = paragraph(block, "**Afterwards you can** ")
        block, self.needs = needs(block)
        return block

    def needed(self):
        """The numbers of the chapters that it needs."""
        return re.findall(r"\[(\d\d)\]\(", " ".join(self.needs))

    def placed(self):
        """The names of the pictures that the lines of the page place."""
        places = (PLACE.match(line) for line in self.body)
        return {name for place in places if place and place[1] == "figure"
                for name in place[2].split()}

    def show_twin(self, step):
        if step in self.twin and step not in self.shown:
            self.body += folded(f"The same in FreeFEM: {step}", fence("freefem", self.twin[step]), "twin")
            self.shown.add(step)

    def live(self, name, words):
        try:
            kind, figure = live_figure(words)
        except BookError as error:
            raise BookError(f"{name}: :live: {words}: {error}") from None
        if kind in self.lives:
            raise BookError(f"{name}: :live: {words}: a page holds one figure of a kind")
        self.lives.append(kind)
        return figure


# The live figures: the picture that stands in their place until the script has taken over, or where it cannot.
STILLS = {"locking": "hero", "string": "string", "convergence": "figure9", "roundoff": "roundoff", "move": "ties", "kernel": "kernel",
          "models": "three_models", "degree": "degree", "bound": "effectivity", "accuracy": "asked_meshes", "beam": "beam",
          "penalty": "interior_penalty_kept", "network": "neural_network", "nitsche": "nitsche",
          "orders": "order_two", "space": "three_dimensions_kept", "solvers": "solver_shapes", "rubber": "elasticity_force", "friction": "friction"}
# What a figure may be told: what its inputs offer.
SETTINGS = {"locking": {"mesh": "structured|unstructured|moved|layered", "cells": "8|16|24|32", "moved": r"0\.\d+",
                        "epsilon": r"0|-[1-8](?:\.\d+)?"}}


def live_figure(text):
    """(kind, the lines of its place): text is the kind, and settings as `mesh=layered`; without a kind it is locking."""
    words = text.split()
    kind = words.pop(0) if words and "=" not in words[0] else "locking"
    if kind not in STILLS:
        raise BookError(f"{kind} is unknown; accepted: {', '.join(STILLS)}")
    accepted, data = SETTINGS.get(kind, {}), ""
    for word in words:
        key, _, value = word.partition("=")
        if key not in accepted or not re.fullmatch(accepted[key], value):
            raise BookError(f"{word} is no setting of {kind}; accepted: " +
                            (", ".join(f"{name}={values}" for name, values in accepted.items()) or "none"))
        data += f' data-{key}="{html.escape(value)}"'
    identity = "live" if kind == "locking" else f"live-{kind}"
    still = (f'<img src="_images/{STILLS[kind]}.webp" alt="A still of the live figure" loading="lazy">'
             '<p class="live-still">This is a still. The live figure needs a browser with scripts, WebAssembly and WebGL2.</p>')
    return kind, ["", f'<div class="live" data-kind="{kind}" id="{identity}"{data}>{still}</div>', ""]
