#!/usr/bin/python3
"""figures/table.py in a small repository: every sign of a caption arrives where it is shown, and
table.py, gallery and reproduce refuse a broken table by its picture and its fault.
Run: table_test.py [unittest's options]
"""
import html
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CAPTION = '''Teeth (4, 8 and 16), "slope" |u_x| < 1; it's 100 % of $HOME & `h`, \\ included.'''
RENDER = ["curves", "results/05_teeth/teeth.csv", "--title", "it's $P_1$, (a) * \\ b"]
BROKEN = CAPTION.replace(", ", ",\n   ")  # into lines, as a long one is
FIRST = f"""[[picture]]
image = "teeth"
figure = 5
chapters = ["05_teeth", "06_more"]
freefem = "05_teeth"
render = ["curves", "results/05_teeth/teeth.csv", "--title", '''{RENDER[-1]}''']
caption = '''
{BROKEN}'''
"""
SECOND = """
[[picture]]
image = "more"
chapters = ["06_more"]
render = ["plan", "results/freefem/compare/more.vtu"]
caption = "More."
"""


class Table(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        for file in ("figures/table.py", "figures/gallery", "figures/reproduce"):
            (self.root / file).parent.mkdir(exist_ok=True)
            shutil.copy(ROOT / file, self.root / file)
        for file in ("tutorials/05_teeth/05_teeth.cpp", "tutorials/06_more/06_more.cpp", "freefem/05_teeth.edp"):
            (self.root / file).parent.mkdir(exist_ok=True, parents=True)
            (self.root / file).touch()
        (self.root / "tutorials/scenes").mkdir()
        (self.root / "tutorials/scenes/drawn.toml").write_text("# render surface\n")
        (self.root / "README.md").write_text(
            "Before\n<!-- table: figures/table.toml nine -->\n<!-- end of table -->\nafter\n")
        (self.root / "figures/README.md").write_text(
            "<!-- table: figures/table.toml -->\n\nold\n<!-- end of table -->\n")
        self.write(FIRST + SECOND)

    def write(self, text):
        (self.root / "figures/table.toml").write_text(text)

    def ask(self, *command):
        done = subprocess.run(command, cwd=self.root, capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    def table(self, *arguments):
        status, said, wrong = self.ask("figures/table.py", *arguments)
        self.assertEqual((status, wrong), (0, ""))
        return said

    # ---- what is read

    def test_a_row_has_every_sign_of_its_caption_and_its_words(self):
        fields = ["teeth", "5", "05_teeth 06_more", "05_teeth", CAPTION, *RENDER]
        self.assertEqual(self.table("rows", "teeth"), "\x1f".join(fields) + "\n")
        second = self.table("rows").splitlines()[1].split("\x1f")
        self.assertEqual(second[:5], ["more", "", "06_more", "", "More."])

    def test_bash_reads_the_same_words(self):
        read = "IFS=$'\\x1f' read -ra fields <<<\"$(figures/table.py rows teeth)\""
        _, said, _ = self.ask("bash", "-c", f"{read}; printf '%s\\n' \"${{fields[@]:4}}\"")
        self.assertEqual(said.splitlines(), [CAPTION, *RENDER])

    def test_the_rows_are_utf8_in_every_locale(self):
        self.write(FIRST.replace("Teeth", "ε"))
        command = ["env", "PYTHONIOENCODING=latin-1", "figures/table.py", "rows", "teeth"]
        said = subprocess.run(command, cwd=self.root, capture_output=True)
        self.assertIn("ε (4, 8", said.stdout.decode("utf-8"))

    def test_what_freefem_alone_computes_is_no_test(self):
        self.assertEqual(self.table("fixtures"), "teeth 05_teeth 06_more\n")

    def test_the_readmes_show_the_captions(self):
        self.assertEqual(self.ask("figures/gallery", "--check")[0], 1)
        self.assertEqual(self.ask("figures/gallery", "--write"), (0, "", ""))
        self.assertEqual(self.ask("figures/gallery", "--check"), (0, "", ""))
        top = (self.root / "README.md").read_text()
        lower = (self.root / "figures/README.md").read_text()
        for text, folder, bars in ((top, "figures/images", 2), (lower, "../figures/images", 3)):
            row = next(line for line in text.splitlines() if "teeth.png" in line)
            self.assertIn(f'src="{folder}/teeth.png"', row)
            self.assertEqual(row.count("|"), bars)  # a caption ends no cell
            self.assertEqual(html.unescape(row).count(CAPTION), 2)  # and as the alternative text
        self.assertRegex(top, "(?s)^Before\n.*\n<!-- end of table -->\nafter\n$")
        self.assertIn("**Figure 5.** ", lower)
        self.assertIn("[05_teeth](../tutorials/05_teeth/05_teeth.cpp), [06_more](../tutorials/06_more/06_more.cpp), "
                      "[05_teeth.edp](../freefem/05_teeth.edp) |", lower)

    # ---- what is refused

    def test_an_unknown_image_is_refused(self):
        self.assertEqual(self.ask("figures/table.py", "rows", "nothing"),
                         (1, "", "figures/table.toml: no image nothing\n"))
        status, _, wrong = self.ask("figures/reproduce", "nothing")
        self.assertEqual(status, 2)
        accepted = "accepted: teeth more drawn\n"
        self.assertEqual(wrong, f"figures/reproduce: no image 'nothing'; {accepted}")
        self.assertEqual(self.ask("figures/table.py", "columns")[0], 1)
        self.assertEqual(self.ask("figures/gallery", "--read")[0], 2)

    def refused(self, fault, *commands):
        for command in commands:
            status, said, wrong = self.ask(*command.split())
            self.assertEqual((status, said, wrong.count("\n")), (1, "", 1), f"{command}: {wrong}")
            self.assertIn(f"figures/table.toml: {fault}", wrong)

    def test_all_that_read_the_table_refuse_a_broken_one(self):
        self.write(FIRST + SECOND.replace('"More."', '"More", and more.'))
        self.refused("Expected newline", "figures/table.py rows", "figures/table.py rows teeth",
                     "figures/table.py fixtures", "figures/gallery", "figures/gallery --check",
                     "figures/gallery --write", "figures/reproduce teeth")
        self.assertIn("old", (self.root / "figures/README.md").read_text())  # nothing was written
        (self.root / "figures/table.toml").unlink()
        self.refused("[Errno 2]", "figures/table.py rows")

    def test_what_is_wrong_with_a_picture_is_named(self):
        for fault, before, after in (
                ("Invalid", 'caption = "More."', "caption = More, without quotes."),
                ("picture 2 (more): no key caption", 'caption = "More."', ""),
                ("picture 2 (no image): no key image", 'image = "more"', ""),
                ("picture 2 (more): no key render",
                 'render = ["plan", "results/freefem/compare/more.vtu"]', ""),
                ("picture 2 (more): unknown key title; accepted: image, chapters",
                 'caption = "More."', 'caption = "More."\ntitle = ""'),
                ("picture 2 (more): unknown chapter 07_none: there is no tutorials/07_none/07_none.cpp",
                 '["06_more"]', '["06_more", "07_none"]'),
                ("picture 2 (more): unknown script: there is no freefem/06_more.edp",
                 'image = "more"', 'image = "more"\nfreefem = "06_more"'),
                ("picture 2 (teeth): a second row of image teeth",
                 'image = "more"', 'image = "teeth"'),
                ("picture 2 (more): a second row of figure 5",
                 'image = "more"', 'image = "more"\nfigure = 5'),
                ("picture 2 (more): figure is no integer",
                 'image = "more"', 'image = "more"\nfigure = true'),
                ("picture 2 (more): chapters is no array of texts", '["06_more"]', '"06_more"'),
                ("picture 2 (more): chapters is empty or", '["06_more"]', "[]"),
                ("picture 2 (more): render is empty or", '"plan"', '"plan", ""'),
                ("picture 2 (more): render is empty or", '"plan"', "1"),
                ("picture 2 (more): render holds a tab", '"plan"', '"plan\\u001f"'),
                ("picture 2 (../more): image holds more than",
                 'image = "more"', 'image = "../more"'),
                ("picture 2 (more): the caption does not end with a full stop",
                 '"More."', '"More"'),
                ("picture 2 (more): caption is empty or", '"More."', '" "'),
                ("accepted: one [[picture]] per picture",
                 '[[picture]]\nimage = "more"', '[[figure]]\nimage = "more"')):
            with self.subTest(fault=fault, after=after):
                self.assertIn(before, SECOND)
                self.write(FIRST + SECOND.replace(before, after))
                self.refused(fault, "figures/table.py rows")


if __name__ == "__main__":
    unittest.main(verbosity=2)
