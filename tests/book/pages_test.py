#!/usr/bin/python3
"""The book of a small repository of three chapters: their order, where the live figures stand, and what must stop the build.
Each fault is put into a copy of its own, and the build must name it. Run: pages_test.py [unittest's options]"""
import html
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from docutils.nodes import make_id
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tutorials/book"))
from course import minutes, read  # noqa: E402
from library import EXAMPLES, Library  # noqa: E402
from literate import STILLS, BookError, code, with_predictions  # noqa: E402
from pages import EXTRA, TEACHING  # noqa: E402

CHAPTERS = {
    "00_start": """// # A first chapter
//
// Run: 00_start    a moment
//
// **Afterwards you can** begin,
// and end.
//
// Needs: nothing,
// at all.
// :live: string
//
// **The picture.** A formula $u ≥ 0$, and chapter 07.
#include "antilock/core/error.hpp"

// ### Solve
int main() { return 0; }
""",
    "07_middle": """// # A second chapter
//
// Run: 07_middle              a moment
// Run: 07_middle --cells 4
// Run: 07_middle --exercise 1
//
// **Afterwards you can** go on.
//
// Needs: [00](../00_start/00_start.cpp) (all of it).
//
// **Predict.** (a) How many,
// by (c) of a list? (b) And then?
//
// Words before the figure.
// :live: mesh=layered cells=8
//
// Words after the figure.
//
// ```
// :live: in a listing is no figure
// ```
//
// ## What came out
//
// Words of the run.
//
// First, (a) one,
// and (b) two.
//
// ## Exercises
//
// 1. A question
//    of two lines.
// 2. On paper.
int main() {
  // ### Output
  // :live: convergence
  return 0;
}
// :page: 07_more
// # Its second page
//
// **Afterwards you can** turn a page.
//
// Words on the second page.
// :figure: second
//
// ## Exercises
//
// 3. On paper, too.
void more() {}
""",
    "27_later": """// # A third chapter
//
// Run: 27_later
//
// Needs: [07](../07_middle/07_middle.cpp).
//
// No figure here.
//
// Words before the pictures.
// :figure: ties
//
// Words between.
// :figure: first string
//
// Words before the table.
// :output: two rows
//
// Words at the end.
#include "antilock/distributed/ranks.hpp"
int main() {}
""",
}
COURSE = """[[part]]
title = "Basics"
kind = "course"
about = "Read both."
chapters = [
  "00_start",
  "07_middle",
]

[[part]]
title = "More"
kind = "track"
about = "Read it."
chapters = [
  "27_later",
]
"""
EXAMPLE = "TEST(SolveTo, TakesTheVentcelLayerForTheRigidLimit) {\n  solve_to();\n}\nTEST(SolveTo, Other) {\n}\n"
CAPTION = 'A string (a "cable"), before, and after: 1 < 2.'


def entry(image, chapter, caption):
    """An entry of figures/table.toml."""
    return (f"[[picture]]\nimage = '{image}'\nchapters = ['{chapter}']\nrender = ['plan']\n"
            f"caption = '''{caption}'''\n")


def small_repository(root):
    shutil.copytree(ROOT / "tutorials/book", root / "tutorials/book", ignore=shutil.ignore_patterns("wasm", "__pycache__"))
    shutil.copy(ROOT / "CITATION.cff", root)
    for folder in ("freefem", "figures/images", "lib/antilock/core", "build/book-parts/static"):
        (root / folder).mkdir(parents=True)
    for stem, text in CHAPTERS.items():
        (root / f"tutorials/{stem}").mkdir()
        (root / f"tutorials/{stem}/{stem}.cpp").write_text(text)
    (root / "tutorials/book/course.toml").write_text(COURSE)
    (root / "tutorials/book/wasm").mkdir()
    (root / "tutorials/book/wasm/runs.csv").write_text("command,seconds,MiB,meshes\n00_start,0.1,,\n07_middle,1.2,70,\n07_middle --cells 4,0.6,,\n"
                                                       "07_middle --exercise 1,40,,\n")
    (root / "tutorials/07_middle/answers.hpp").write_text(
        "#pragma once\n// The answers to the exercises.\nint answer();\n\n"
        "// ## Answers on paper\n//\n// **2.** By chapter 00, $x = 1$.\n"
        "//\n// **3.** By page two.\n")
    (root / "freefem/00_start.edp").write_text("// ### Solve\nreal a = 1;\n")
    (root / "lib/antilock/core/error.hpp").write_text("#pragma once\nclass Error {};\n")
    for folder, file, text in (("lib/antilock/adapt", "solve_to.hpp", "#pragma once\nint solve_to();\n"),
                               ("tests/unit/adapt", "solve_to_test.cpp", EXAMPLE)):
        (root / folder).mkdir(parents=True)
        (root / folder / file).write_text(text)
    (root / "tutorials/README.md").write_text("# Tutorials\n\n## The theory as experiments\n\nNone.\n")
    (root / "tutorials/book/index.md").write_text("# The index\n\nBegin with [a start](../00_start/00_start.cpp).\n\n:live:\n\n:chapters:\n")
    (root / "tutorials/guides").mkdir()
    for page in EXTRA + TEACHING:
        (root / f"tutorials/guides/{page}.md").write_text(f"# The {page}\n\nNone.\n")
    (root / "tutorials/guides/glossary.md").write_text("# Glossary\n\n| term | in one line | chapter |\n|---|---|---|\n| figure | what one *looks* at | 00 |\n"
                                                "| words (of a page) | no such link | 00 |\n")
    for still in STILLS.values():
        Image.new("RGB", (4, 4)).save(root / f"figures/images/{still}.png")
    for picture in ("ties", "first", "second"):
        Image.new("RGB", (4, 4)).save(root / f"figures/images/{picture}.png")
    shutil.copy(ROOT / "figures/table.py", root / "figures")
    (root / "figures/table.toml").write_text(
        entry("string", "00_start", CAPTION) + entry("first", "27_later", "The first.") +
        entry("second", "07_middle", "The second.") +
        entry("ties", "27_later", "The ties.") + entry("hero", "27_later", "On top."))
    (root / "results/logs").mkdir(parents=True)
    (root / "results/logs/27_later.log").write_text("27_later: a run\n\n  two rows of it\na  1\nb  2\n\nVERDICT holds: all\n")
    for script in ("live.js", "live_data.js", "meshes_data.js"):
        (root / f"build/book-parts/static/{script}").touch()


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = Path(cls.folder.name)
        small_repository(cls.root)
        for command in (cls.pages, cls.sphinx):
            status, said = command()
            if status != 0:
                raise AssertionError(f"the sources as they are: {said}")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def ask(cls, *command):
        done = subprocess.run(command, cwd=cls.root, capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    @classmethod
    def pages(cls):
        return cls.ask("tutorials/book/pages.py", "build/pages", "--without-runs")

    @classmethod
    def sphinx(cls):
        return cls.ask("sphinx-build", "-q", "-W", "--keep-going", "-c", "tutorials/book", "build/pages", "build/book")

    def page(self, stem, suffix="md", folder="pages"):
        return (self.root / f"build/{folder}/{stem}.{suffix}").read_text()

    # ---- order

    def test_the_index_has_every_chapter_once_in_the_order_of_the_parts(self):
        index = self.page("index")
        self.assertEqual(re.findall(r"<(\d\d_\w+)>", index),
                         ["00_start", "07_middle", "07_more", "27_later"])
        self.assertEqual(re.findall(r":caption: (\w+)", index), ["Basics", "More", "For", "To"])
        self.assertRegex(index, r"(?s)## Basics: some 0 hours\n\nRead both\. It needs no other chapter\..*\[07 A second chapter\]\(07_middle\.md\) \| 5 \|"
                                r".*## More\n\nRead it\. About 5 minutes\. It needs the course\. Nothing later needs it\.")

    def test_a_chapter_says_where_it_stands_and_how_long_it_takes(self):
        self.assertIn("**Basics, chapter 1 of 3.** About 5 minutes.\n"
                      "**Afterwards you can** begin,\nand end.\n\nNeeds: nothing",
                      self.page("00_start"))
        self.assertIn("**Basics, chapter 2 of 3.** About 5 minutes.\n"
                      "**Afterwards you can** go on.", self.page("07_middle"))
        self.assertIn("**More.** About 5 minutes.", self.page("27_later"))

    def test_minutes_are_those_of_words_formulas_lines_and_runs(self):
        def measured(text):
            return minutes(text.splitlines())
        self.assertEqual(measured("// # A\n//\n// " + "word " * 1000), 20)
        self.assertEqual(measured("// " + "$x^2$ " * 100), 30)
        self.assertEqual(measured("// $$ x = y $$\n//\n" * 10), 30)
        self.assertEqual(measured("// # A\n" + "int a;\n\n" * 200), 20)
        run = "// Run: a --cells 4    words that take no time\n"
        self.assertEqual(measured("// # A\n//\n" + run * 10), 20)
        self.assertEqual(measured("// # A\n"), 5)

    def test_a_chapter_leads_to_the_next_whatever_numbers_are_free(self):
        pages = ["00_start", "07_middle", "07_more", "27_later"]
        for before, after in zip(pages, pages[1:]):
            self.assertIn(f'class=next-page href={after}.html', self.page(before, "html", "book"))
            self.assertIn(f'class=prev-page href={before}.html', self.page(after, "html", "book"))
        stems = sorted(CHAPTERS)
        for before, after in zip(stems, stems[1:]):
            self.assertRegex(self.page(before), rf"Leads to: \[{after[:2]} [^]]*\]\({after}\.md\)\.")

    # ---- a second page

    def test_a_second_page_has_its_own_pictures_and_answers_and_the_same_program(self):
        first, second = self.page("07_middle"), self.page("07_more")
        for words in ("# 07 Its second page", "**Basics, chapter 3 of 3.** About 5 minutes.",
                      "**Afterwards you can** turn a page.", "images/second.webp",
                      "**3.** By page two.", "void more()", "tutorials/07_middle/07_middle.cpp"):
            self.assertIn(words, second)
            if not words.startswith("tutorials"):
                self.assertNotIn(words, first)
        for words in ("**2.** By", "int main()", "--exercise"):
            self.assertIn(words, first)
            self.assertNotIn(words, second)
        # its button runs the program of the chapter
        self.assertIn('data-program="07_middle"', second)
        self.assertEqual(re.findall(r'data-run="([^"]*)"', second), ["", ""])

    # ---- live figures

    def test_a_live_figure_stands_where_its_line_stands(self):
        def places(stem):
            return re.findall(r'<div class="live" ([^>]*)>', self.page(stem))
        self.assertEqual(places("00_start"), ['data-kind="string" id="live-string"'])
        self.assertEqual(places("07_middle"), ['data-kind="locking" id="live" data-mesh="layered" data-cells="8"',
                                               'data-kind="convergence" id="live-convergence"'])
        self.assertEqual(places("27_later"), [])
        self.assertRegex(self.page("00_start"), r'(?s)Needs: nothing,\nat all\..*images/string.*class="live".*The picture')
        self.assertRegex(self.page("07_middle"), r'(?s)Words before.*data-kind="locking".*Words after.*no figure.*### Output.*"convergence"')

    # ---- runs

    def test_a_command_is_a_button_and_an_exercise_asks_for_a_prediction(self):
        page = self.page("07_middle")
        self.assertEqual(re.findall(r'data-run="([^"]*)"', page), ["", "--exercise 1", "", "--cells 4"])  # the first one is the default run
        self.assertRegex(page, r'1\. A question\n   of two lines\. <span class="predict"><input [^>]*> <button [^>]*"--exercise 1"')
        self.assertEqual(re.findall(r'class="takes">([^<]*)', page), ["about 2 s, 70 MiB", "about 80 s", "about 2 s, 70 MiB", "about a second"])
        self.assertNotIn("| `07_middle --exercise 1`", page)  # it stands in its place
        self.assertIn("does not run in a page", self.page("27_later"))
        self.assertNotIn("data-run", self.page("27_later"))

    # ---- code

    def test_the_lines_that_judge_a_run_are_folded(self):
        program = """void judge(int n, Report& report);
void judge(int n,
           Report& report) {
  report.claim(n == 1, "one");
}
void run(Report& report) {
  for (int n : {1, 2, 3, 4}) {
    measure(n);
    draw(n);
    print(n);
    report.claim(true, "inside a longer statement");
  }
  int shown = 2;
  // why
  if (shown == 2)
    report.claim(true, "two");
  judge(1, report);
}
int behind;""".splitlines()
        page = "\n".join(code(program))
        fold = r"<details[^>]*><summary>The verdict: (\d+) lines</summary>(.*?)</details>"
        parts = re.split(fold, page, flags=re.S)
        self.assertEqual([parts[1], parts[4]], ["4", "5"])
        for words, part in (("int n, Report& report);", 0), ("int n,\n", 2),
                            ("longer statement", 3), ("int shown", 3), ("// why", 5),
                            ("judge(1", 5), ("int behind", 6)):
            self.assertIn(words, parts[part])
        for line in program:  # nothing is lost
            self.assertIn(line.strip(), page)

    # ---- predictions

    def test_a_prediction_has_a_field_per_question_and_stands_beside_the_answer(self):
        page = self.page("07_middle", "html", "book")
        fields = re.findall(r"<span>(Your[^<]*)</span> <input type=text data-question=(\w)", page)
        self.assertEqual(fields, [("Your prediction (a)", "a"), ("Your prediction (b)", "b")])
        self.assertRegex(page, r"(?s)And then\?</p>\s*"
                               r"<div class=predictions data-page=07_middle hidden>.*Words before the")
        self.assertRegex(page, r"(?s)Words of the run\.</p>\s*<div class=predicted hidden></div>\s*"
                               r"<p>First, \(a\)")
        self.assertNotIn("predict", self.page("00_start", "html", "book"))

    def test_a_prediction_without_letters_has_one_field(self):
        lines = ["**Predict.** How many?", "", "## What came out", "", "One."]
        found = "\n".join(with_predictions(lines, "00_start"))
        self.assertEqual(found.count("<input "), 1)
        self.assertRegex(found, r'(?s)How many\?\n\n<div class="predictions".*What came out\n\n+'
                                r'<div class="predicted" hidden></div>\n+One')

    def test_a_prediction_without_an_answer_stops_the_build(self):
        message = r'^00_start.cpp: no section "## What came out", which answers the predictions$'
        with self.assertRaisesRegex(BookError, message):
            with_predictions(["**Predict.** How many?", ""], "00_start")

    # ---- pictures and output

    def test_a_picture_and_a_table_stand_where_their_line_stands(self):
        self.assertRegex(self.page("27_later"),
                         r"(?s)images/hero.*before the pictures.*images/ties.*Words between.*container} pictures"
                         r".*images/first.*images/string.*before the table.*```text\n  two rows of it\na  1\nb  2\n```"
                         r".*at the end.*## What it prints.*\*\*holds\*\*")
        self.assertEqual(self.page("27_later").count("{figure}"), 4)
        self.assertEqual(self.page("27_later").count("two rows of it"), 2)  # there, and in all that it printed

    def test_a_caption_and_its_alternative_text_keep_every_sign(self):
        page = self.page("00_start", "html", "book")
        alt = next(tag for tag in re.findall(r"<img [^>]*>", page) if "images/string" in tag)
        self.assertIn(CAPTION, html.unescape(alt))
        shown = re.search("<figcaption>(.*?)</figcaption>", page, re.S)[1]
        shown = html.unescape(re.sub("<[^>]*>", "", shown))
        self.assertIn(CAPTION, shown.translate(str.maketrans("“”", '""')))  # Sphinx sets quotes

    # ---- references

    def test_the_first_use_of_a_term_leads_to_its_line(self):
        page = self.page("07_middle", "html", "book")
        self.assertEqual(re.findall(r"<a class=term href=([^>]*)>([^<]*)</a>", page), [("glossary.html#term_figure", "figure")])
        self.assertIn('"glossary.html#term_figure": "what one <em>looks</em> at"', (self.root / "build/book/_static/hints.js").read_text())

    # ---- answers

    def test_the_answers_on_paper_are_folded_under_their_chapter(self):
        self.assertIn("Answers on paper", self.page("07_middle"))
        self.assertRegex(self.page("07_middle", "html", "book"),
                         r'(?s)<details class=answers><summary>Answers on paper</summary>.*<strong>2\.</strong> By chapter <a [^>]*00_start')
        self.assertNotIn("The answers to the exercises", self.page("07_middle"))
        self.assertNotIn("Answers on paper", self.page("00_start"))

    # ---- links

    def test_links_formulas_and_code_of_a_line_are_told_apart(self):
        from links import linked
        def one(line, **more):
            return linked([line], lambda to: to.replace(".cpp", ".md") if to.endswith(".cpp") else None, lambda number: {"07": "07_kernel"}.get(number),
                          {"23": "01_domain"}, self.fail, str.upper, **more)[0]
        for line, says in (("see [a `b` c](07_kernel.cpp)", "SEE [A `b` C](07_kernel.md)"), ("[a](lab.py)", "`lab.py`"), ("![a](x.png)", "A"),
                           ("Chapter 07 and chapters 07, 98", "Chapter [07](07_kernel.md) AND chapters [07](07_kernel.md), 98"),
                           ("by (23), (99) and f(23)", 'BY <a href="01_domain.html#eq-23">(23)</a>, (99) AND F(23)'),
                           ("`f(23)` $x (23)$ (23)", '`f(23)` $x (23)$ <a href="01_domain.html#eq-23">(23)</a>'),
                           ("`[](int x)` and [](int x)", "`[](int x)` AND \\[\\](INT X)"), ("# of (23)", "# OF (23)"), ("    x (23)", "    x (23)"),
                           ("$$ a (23) \\tag{23} $$ and (23)", '$$ a (23) \\tag{23} $$ AND <a href="#eq-23">(23)</a>')):
            self.assertEqual(one(line), says)
        self.assertEqual(one("A locks-b, Lock, locks and lock", terms=["lock"]),
                         'A LOCKS-B, <a class="term" href="glossary.html#term_lock">Lock</a>, LOCKS AND LOCK')
        self.assertEqual(one("| lock |", terms=["lock"]), "| LOCK |")

    # ---- the library

    def test_a_header_has_its_example(self):
        self.assertRegex(self.page("library_adapt"), r"(?s)solve_to\.hpp.*adapt/solve_to_test.cpp`:\n\n```cpp\nTEST\(SolveTo, Takes\w+\) {\n  solve_to\(\);\n}\n```")
        library = Library(ROOT / "lib")
        for header in EXAMPLES:
            self.assertGreater(len(library.example(ROOT / "lib/antilock" / header)), 0)

    def test_every_header_of_0_2_keeps_its_address(self):
        library, pages = Library(ROOT / "lib"), {}
        library.write(lambda name, lines: pages.update({name: "\n".join(lines)}), [])
        for old, heirs in library.moved.items():
            for new in heirs:
                self.assertTrue((ROOT / "lib/antilock" / new).exists(), f"moved.csv: {old} is to be {new}, which does not exist")
            self.assertFalse((ROOT / "lib/antilock" / old).exists(), f"moved.csv: {old} did not move")
            self.assertIn(f'id="{make_id(old)}"', pages[f"library_{old.split('/')[0]}"])
        for module in library.modules:
            self.assertIn(f'id="room-{module}"', pages[f"library_{module}"])

    # ---- tables and captions

    def test_letters_that_are_written_out_become_signs(self):
        sys.path.insert(0, str(ROOT / "tutorials/book"))
        from literate import signs
        for text, shown in (("u_h^epsilon -> u^0", "u<sub>h</sub><sup>ε</sup> → u<sup>0</sup>"),
                            ("a_x^-(u_h^+, v)", "a<sub>x</sub><sup>−</sup>(u<sub>h</sub><sup>+</sup>, v)"),
                            (r"\|.\|_{1,Omega_h}", r"\|.\|<sub>1,Ω<sub>h</sub></sub>"),
                            ("theta, zeta and chi_h", "θ, zeta and χ<sub>h</sub>"),
                            ("h << epsilon^(8/3)", "h ≪ ε<sup>8/3</sup>"), ("h^1.12, K_0h", "h<sup>1.12</sup>, K<sub>0h</sub>"),
                            ("(t h / epsilon)^2.", "(t h / ε)<sup>2</sup>."), ("10^-2.5 >= 1/epsilon", "10<sup>−2.5</sup> ≥ 1/ε"),
                            ("06_p1_unstructured (13_uniform)", "06_p1_unstructured (13_uniform)")):
            self.assertEqual(signs(text), shown)

    # ---- what stops the build

    def refused(self, says, file, line, command, instead_of=None):
        """With `line` at the end of the file, or in the place of another, the command fails and says so."""
        path = self.root / file
        kept = path.read_text()
        path.write_text(kept + line + "\n" if instead_of is None else kept.replace(instead_of, line))
        try:
            status, said = command()
        finally:
            path.write_text(kept)
        self.assertNotEqual(status, 0, f"{line} was let through")
        self.assertIn(says, said)

    def both(self):
        status, said = self.pages()
        return (status, said) if status != 0 else self.sphinx()

    def test_what_is_wrong_is_named(self):
        chapter = "tutorials/00_start/00_start.cpp"
        for says, file, line in (
                ("unknown link", chapter, "// [nowhere](no_such_file.cpp)"),
                ("chapter 98 does not exist", chapter, "// As chapter 98 says."),
                ("figures/images/none.png is missing", "figures/table.toml",
                 entry("none", "00_start", "A picture.")),
                ("picture 6 (more): unknown chapter 28_more", "figures/table.toml",
                 entry("more", "28_more", "Another.")),
                ("00_start.cpp: :live: tree: tree is unknown; accepted: locking", chapter, "// :live: tree"),
                ("mesh=round is no setting of locking; accepted: mesh=structured|", chapter, "// :live: mesh=round"),
                ("cells=9 is no setting of string; accepted: none", "tutorials/27_later/27_later.cpp", "// :live: string cells=9"),
                ("a page holds one figure of a kind", chapter, "// :live: string"),
                ("tutorials/00_start: `ε ≥ 0`: a formula stands between dollars", chapter, "// For `ε ≥ 0`."),
                (":figure: tree: no picture of figures/table.toml", chapter, "// :figure: tree"),
                ("00_start.cpp: :page: 07_other: accepted: a new name that begins with 00_",
                 chapter, "// :page: 07_other"),
                (":page: 00_start: accepted: a new name", chapter, "// :page: 00_start"),
                ("lecture_1.md: :figure: tree: no picture", "tutorials/guides/lecture_1.md",
                 "\n:figure: tree"),
                ("27_later.cpp: :figure: ties: it stands on the page already", "tutorials/27_later/27_later.cpp", "// :figure: ties"),
                ("27_later.cpp: no line places the picture more", "figures/table.toml",
                 entry("more", "27_later", "Another.")),
                ("27_later.cpp: :output: three: no line of", "tutorials/27_later/27_later.cpp", "// :output: three"),
                ('step "Dance"', "freefem/00_start.edp", "// ### Dance")):
            with self.subTest(line=line):
                self.refused(says, file, line, self.pages)
        with self.subTest("example"):
            self.refused("solve_to.hpp: its example, SolveTo", "tests/unit/adapt/solve_to_test.cpp", "", self.pages, "TakesTheVentcelLayer")
        with self.subTest("seconds"):
            self.refused("07_middle --cells 8 has no row in wasm/runs.csv", "tutorials/07_middle/07_middle.cpp", "07_middle --cells 8", self.pages, "07_middle --cells 4")
        with self.subTest("answer"):
            self.refused("07_middle.cpp: exercise 2 has no answer", "tutorials/07_middle/answers.hpp", "**3.**", self.pages, "**2.**")
        moved = COURSE.replace('"27_later"', '"27_later", "07_more"')
        with self.subTest("a second page that a line places"):
            more = self.root / "tutorials/book/course.toml"
            more.write_text(moved)
            parts = read(self.root / "tutorials")
            more.write_text(COURSE)
            self.assertEqual([part.pages for part in parts],
                             [["00_start", "07_middle"], ["27_later", "07_more"]])
            self.assertEqual(parts[1].second, {"07_more": ("07_middle", "Its second page")})
        swapped = COURSE.replace("07_middle", "28_more").replace("27_later", "07_middle").replace("28_more", "27_later")
        for says, table in (
                ("27_later stands in it 0 times; accepted: once", COURSE.replace("27_later", "28_more")),
                ("00_start stands in it 2 times; accepted: once", COURSE.replace('"27_later"', '"27_later", "00_start"')),
                ("07_more stands in it 2 times; accepted: once",
                 moved.replace('"00_start"', '"00_start", "07_more"')),
                ("there is no chapter 28_more", COURSE.replace('"27_later"', '"27_later", "28_more"')),
                ("part More: kind path is unknown; accepted: course, track, appendix", COURSE.replace('"track"', '"path"')),
                ("part Basics: unknown key abuot; accepted: title", COURSE.replace("about", "abuot = 1\nabout", 1)),
                ("the course needs chapter 07, which is none of its chapters", swapped)):
            with self.subTest(course=says):
                self.refused(says, "tutorials/book/course.toml", table, self.pages, COURSE)
        with self.subTest("objectives"):
            self.refused('00_start.cpp: no paragraph "**Afterwards you can** ..."', chapter, "// **Later you can** begin", self.pages, "// **Afterwards you can** begin")
        with self.subTest("title"):
            self.refused("accepted: at most six", chapter, "// # A title of more than six words", self.pages, "// # A first chapter")

    def test_what_sphinx_finds_is_named(self):
        for says, line in (("not found", "// [nowhere](../07_middle/07_middle.cpp#no-such-place)"), ("KaTeX parse error", r"// $\frac{1$")):
            with self.subTest(line=line):
                self.refused(says, "tutorials/00_start/00_start.cpp", line, self.both)


if __name__ == "__main__":
    unittest.main(verbosity=2)
