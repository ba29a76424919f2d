"""The library's headers as pages, one per room, and the names in code that lead there."""
import re

from docutils.nodes import make_id

from literate import BookError

ROOMS = "core scene mesh space form problem models solve exact measure analysis adapt study distributed io".split()
TYPE = re.compile(r"^(?:class|struct|enum class) (\w+)[^;]*$")
FUNCTION = re.compile(r"^(?!return|using|namespace|template|#|//|\})(?:[\w:<>,*&]+ )+[*&]?(\w+)\(")
# By header, an example: a file of tests/, and of it one test (none: the whole program). The tests run them all.
EXAMPLES = {
    "scene/scene.hpp": ("package/main.cpp", None),
    "space/space.hpp": ("unit/space_test.cpp", "Space, CrouzeixRaviartUnknownsAreEdgeMidpoints"),
    "problem/variational_inequality.hpp": ("unit/problem_test.cpp", "Check, TakesAnA1OfZerosWhereBHoldsEverything"),
    "solve/active_set.hpp": ("unit/solve_test.cpp", "ActiveSet, LimitProblemOnAStructuredMeshIsVentcels"),
    "solve/contact.hpp": ("unit/solve_test.cpp", "ContactProblem, AWrongSideCostsAStepPerPiece"),
    "analysis/locking.hpp": ("unit/analysis_test.cpp", "LockingDiagnosis, FindsThatAHalfIsHeld"),
    "analysis/certificate.hpp": ("unit/analysis_test.cpp", "Certificate, BoundsTheEnergyOfAScaledSolution"),
    "analysis/lost_energy.hpp": ("unit/analysis_test.cpp", "LostEnergy, IsToldByTheSecondSolveWhereTheGapIsAsFineAsTheMesh"),
    "adapt/solve_to.hpp": ("unit/adapt_test.cpp", "SolveTo, TakesTheVentcelLayerForTheRigidLimit"),
}


class Library:
    def __init__(self, lib):
        self.lib = lib
        self.rooms = [room for room in ROOMS if list((lib / "antilock" / room).glob("**/*.hpp"))]

    def headers(self, room):
        return sorted((self.lib / "antilock" / room).glob("**/*.hpp"))

    def short(self, header):
        return header.relative_to(self.lib / "antilock").as_posix()

    def page(self, header, suffix=".md"):
        short = self.short(header)
        return f"library_{short.split('/')[0]}{suffix}#{make_id(short)}"

    def page_names(self):
        return [f"library_{room}" for room in self.rooms]

    def declared(self, header, patterns=(TYPE, FUNCTION)):
        """The names that a header declares, each once, in its order."""
        found = (pattern.match(line) for line in header.read_text().splitlines() for pattern in patterns)
        return list(dict.fromkeys(match[1] for match in found if match))

    def names(self):
        """({type: page}, {function: page}) of what the headers declare; a name of two headers leads to the first."""
        known = {}, {}
        for room in self.rooms:
            for header in self.headers(room):
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

    def write(self, write, chapters):
        """A page per room: each header, and the chapters that use what it declares. They are its examples: each is a
        program that the tests run."""
        words = {chapter.stem: set(re.findall(r"\w+", re.sub("//.*|\".*?\"", "", chapter.read_text()))) for chapter in chapters}
        for room in self.rooms:
            out = [f"# Room {room}", ""]
            for header in self.headers(room):
                out += [f"## {self.short(header)}", "", "```cpp", header.read_text().rstrip(), "```", "", *self.example(header)]
                used = {name: ", ".join(f"[{stem[:2]}]({stem}.md)" for stem in words if name in words[stem]) for name in self.declared(header)}
                out += [f"- `{name}`: used in chapter {chapters}" for name, chapters in used.items() if chapters]
                unused = ", ".join(f"`{name}`" for name, chapters in used.items() if not chapters)
                out += [f"- no chapter uses {unused} by name", ""] if unused and "/detail/" not in str(header) else [""]
            write(f"library_{room}", out)
        write("library", ["# The library's headers", "", "A room includes only rooms before it. Below each header stand the chapters that use it, and",
                          "below central ones an example: the tests compile and run them all.", "",
                          "```{toctree}", ":maxdepth: 2", "", *(f"library_{room}" for room in self.rooms), "```"])


class NameLinks:
    """Turns the names of a page's code into links to their headers, each name once per block."""

    def __init__(self, library):
        self.types, self.functions = library.names()
        self.includes = {f"antilock/{library.short(header)}": library.page(header, ".html")
                         for room in library.rooms for header in library.headers(room)}

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
