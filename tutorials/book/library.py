"""The library's headers as pages, one per module, and the names in code that lead there."""
import csv
import re
from pathlib import Path

from docutils.nodes import make_id

from literate import BookError

MODULES = "core problem solve scene mesh space io form models exact measure analysis certificate adapt study distributed runner".split()
TYPE = re.compile(r"^(?:class|struct|enum class) (\w+)[^;]*$")
FUNCTION = re.compile(r"^(?!return|using|namespace|template|#|//|\})(?:[\w:<>,*&]+ )+[*&]?(\w+)\(")
# By header, an example: a file of tests/, and of it one test (none: the whole program). The tests run them all.
EXAMPLES = {
    "scene/scene.hpp": ("package/main.cpp", None),
    "space/space.hpp": ("unit/space/space_test.cpp", "Space, CrouzeixRaviartUnknownsAreEdgeMidpoints"),
    "problem/variational_inequality.hpp": ("unit/problem/variational_inequality_test.cpp", "Check, TakesAnA1OfZerosWhereBHoldsEverything"),
    "solve/active_set.hpp": ("unit/solve/active_set_test.cpp", "ActiveSet, LimitProblemOnAStructuredMeshIsVentcels"),
    "solve/contact.hpp": ("unit/solve/contact_test.cpp", "ContactProblem, AWrongSideCostsAStepPerStatus"),
    "analysis/locking.hpp": ("unit/analysis/locking_test.cpp", "LockingDiagnosis, FindsThatAHalfIsHeld"),
    "certificate/certificate.hpp": ("unit/certificate/certificate_test.cpp", "Certificate, BoundsTheEnergyOfAScaledSolution"),
    "analysis/locking_loss.hpp": ("unit/analysis/locking_report_test.cpp", "LockingLoss, IsToldByTheSecondSolveWhereTheGapIsAsFineAsTheMesh"),
    "adapt/solve_to.hpp": ("unit/adapt/solve_to_test.cpp", "SolveTo, TakesTheVentcelLayerForTheRigidLimit"),
}


class Library:
    def __init__(self, lib):
        self.lib = lib
        rows = csv.DictReader((Path(__file__).parent / "moved.csv").read_text().splitlines())
        self.moved = {row["header"]: row["now"].split() for row in rows}  # a header of 0.2: the headers that have its names now
        self.modules = [module for module in MODULES if list((lib / "antilock" / module).glob("**/*.hpp"))]

    def headers(self, module):
        return sorted((self.lib / "antilock" / module).glob("**/*.hpp"))

    def short(self, header):
        return header.relative_to(self.lib / "antilock").as_posix()

    def page(self, header, suffix=".md"):
        short = self.short(header)
        return f"library_{short.split('/')[0]}{suffix}#{make_id(short)}"

    def page_names(self):
        return [f"library_{module}" for module in self.modules]

    def declared(self, header, patterns=(TYPE, FUNCTION)):
        """The names that a header declares, each once, in its order."""
        found = (pattern.match(line) for line in header.read_text().splitlines() for pattern in patterns)
        return list(dict.fromkeys(match[1] for match in found if match))

    def names(self):
        """({type: page}, {function: page}) of what the headers declare; a name of two headers leads to the first."""
        known = {}, {}
        for module in self.modules:
            for header in self.headers(module):
                for pattern, pages in zip((TYPE, FUNCTION), known):
                    for name in self.declared(header, [pattern]):
                        pages.setdefault(name, self.page(header, ".html"))
        return known

    def example(self, header):
        """The lines of the header's example; a BookError where the test is gone."""
        if self.short(header) not in EXAMPLES:
            return []
        file, test = EXAMPLES[self.short(header)]
        path = self.lib.parent / "tests" / file
        text = path.read_text() if path.exists() else ""
        code = text if test is None else (re.findall(rf"(?ms)^TEST\({test}\) \{{$.*?^\}}$", text) or [""])[0]
        if not code:
            raise BookError(f"{self.short(header)}: its example, {test or 'a program'} in tests/{file}, is not there (library.py)")
        return [f"An example, from `tests/{file}`:", "", "```cpp", code.rstrip(), "```", ""]

    def moved_headers(self, module):
        """The headers that 0.2 had in this module and that stand elsewhere now, each under its old address. A small repository
        has none of their heirs and gets no list."""
        out = []
        for old, heirs in self.moved.items():
            there = [new for new in heirs if (self.lib / "antilock" / new).exists()]
            if old.split("/")[0] == module and there:
                links = ", ".join(f'<a href="{self.page(self.lib / "antilock" / new, ".html")}">{new}</a>' for new in there)
                out.append(f'- <span id="{make_id(old)}"></span>`{old}` is now {links}')
        return ["## Headers of 0.2 that moved", "", *out, ""] if out else []

    def write(self, write, chapters):
        """A page per module: each header, and the chapters that use what it declares. They are its examples: each is a
        program that the tests run."""
        words = {chapter.stem: set(re.findall(r"\w+", re.sub("//.*|\".*?\"", "", chapter.read_text()))) for chapter in chapters}
        for module in self.modules:
            # In 0.2 the page's title was "Room NAME"; its address stays valid.
            out = [f'<span id="room-{module}"></span>', "", f"# Module {module}", ""]
            for header in self.headers(module):
                out += [f"## {self.short(header)}", "", "```cpp", header.read_text().rstrip(), "```", "", *self.example(header)]
                used = {name: ", ".join(f"[{stem[:2]}]({stem}.md)" for stem in words if name in words[stem]) for name in self.declared(header)}
                out += [f"- `{name}`: used in chapter {chapters}" for name, chapters in used.items() if chapters]
                unused = ", ".join(f"`{name}`" for name, chapters in used.items() if not chapters)
                out += [f"- no chapter uses {unused} by name", ""] if unused and "/detail/" not in str(header) else [""]
            out += self.moved_headers(module)
            write(f"library_{module}", out)
        write("library", ["# The library's headers", "", "A module includes only modules before it. Below each header stand the chapters that use it, and",
                          "below central ones an example: the tests compile and run them all.", "",
                          "```{toctree}", ":maxdepth: 2", "", *(f"library_{module}" for module in self.modules), "```"])


class NameLinks:
    """Turns the names of a page's code into links to their headers, each name once per block."""

    def __init__(self, library):
        self.types, self.functions = library.names()
        self.includes = {f"antilock/{library.short(header)}": library.page(header, ".html")
                         for module in library.modules for header in library.headers(module)}

    def block(self, code):
        seen = set()

        def name(found):
            before, name, after = found[1], found[2], found[3]
            to = self.types.get(name)
            if to is None and after and not re.search(r'class="(n|nc|kt)">[^<]*</span>(<span class="w"> +</span>)?$', before):
                to = self.functions.get(name)
            if to is None or name in seen:
                return found[0]
            seen.add(name)
            return found[0].replace(f">{name}<", f'><a href="{to}">{name}</a><', 1)

        code = re.sub(r'((?:<span class="\w+">[^<]*</span>)?(?:<span class="w"> +</span>)?)<span class="n[cf]?">(\w+)</span>(<span class="p">\()?',
                      name, code)
        return re.sub(r'&quot;(antilock/[\w/]+\.hpp)&quot;',
                      lambda f: f'<a href="{self.includes[f[1]]}">&quot;{f[1]}&quot;</a>' if f[1] in self.includes else f[0], code)

    def inline(self, found):
        name = found[2].removesuffix("()")
        to = self.types.get(name) or self.functions.get(name) or self.includes.get("antilock/" + name)
        return f'<a class="name" href="{to}">{found[0]}</a>' if to else found[0]

    def __call__(self, body):
        body = re.sub(r'<div class="highlight-cpp notranslate">.*?</div>', lambda f: self.block(f[0]), body, flags=re.S)
        return re.sub(r'(?<!">)(<code class="docutils literal notranslate"><span class="pre">)([\w/.]+(?:\(\))?)(</span></code>)', self.inline, body)
