#!/usr/bin/python3
"""The programs in their pages say what they say on this machine: the verdicts of every exercise, and of the chapters that
take a moment. Run: programs_test.py PARTS PROGRAMS EXERCISES     build/book-parts, the folder of the programs, and where
tests/chapters/exercises left what the exercises print"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
TUTORIALS = HERE.parents[1] / "tutorials"
PARTS, PROGRAMS, EXERCISES = (Path(word).resolve() for word in sys.argv[1:4])

sys.path.insert(0, str(TUTORIALS / "book"))
from runs import rows  # noqa: E402

ROWS = {row["command"]: row for row in rows()}


def commands():
    """Every `Run:` line of the chapters that run in their pages."""
    for source in sorted(TUTORIALS.glob("[0-9][0-9]_*/[0-9][0-9]_*.cpp")):
        text = source.read_text()
        if not re.search(r'#include "(antilock/distributed|petsc)/', text):
            yield from (found.split() for found in re.findall(r"^// Run: (.*?)(?:  .*)?$", text, re.M))


def native(command, **variables):
    """(exit status, what it printed, what it printed as errors) on this machine"""
    with tempfile.TemporaryDirectory() as out:
        done = subprocess.run([PROGRAMS / command[0], *command[1:]], capture_output=True, text=True, timeout=300, cwd=out,
                              env={**os.environ, **variables})
    return done.returncode, done.stdout, done.stderr


def verdicts(text):
    """The verdicts, without their numbers: the last digits are those of another factor and another libm."""
    lines = [line for line in text.splitlines() if line.startswith(("VERDICT", "NOT JUDGED", "QUESTION", "PREDICTION"))]
    return [re.sub(r"(?<![\w.])-?\d[\d.]*(?:e[-+]?\d+)?", "#", line) for line in lines]


class Programs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.node = subprocess.Popen(["node", HERE / "run_programs.mjs", PARTS], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.node.communicate()

    def page(self, command):
        """The same of the page, and the MiB that it takes."""
        print(json.dumps(command), file=self.node.stdin, flush=True)
        said = json.loads(self.node.stdout.readline())
        return said["status"], said["out"], said["errors"], said["MiB"]

    def both(self, command):
        """What the machine and the page say of one command."""
        with tempfile.TemporaryDirectory() as meshes:
            here = native(command, ANTILOCK_MESHES=meshes)
            self.asked_for(command, Path(meshes))
        return here, self.page(command)

    def asked_for(self, command, meshes):
        """The meshes that it asked gmsh for are those that runs.csv names."""
        row = ROWS.get(" ".join(command))
        if row:
            self.assertEqual(sorted(path.name for path in meshes.iterdir()), row["meshes"].split(), "tutorials/book/wasm/measure notes them")

    def test_every_exercise_ends_as_on_the_machine(self):
        asked = [command for command in commands() if "--exercise" in command]
        self.assertGreater(len(asked), 50)
        for command in asked:
            with self.subTest(command=" ".join(command)):
                here = EXERCISES / f"{command[0]}.{command[2]}"  # it ended with status 0, or this test would not run
                self.asked_for(command, Path(f"{here}.meshes"))
                page = self.page(command)
                self.assertEqual((page[0], verdicts(page[1])), (0, verdicts(here.read_text())), page[2])

    def test_short_chapters_end_as_on_the_machine(self):
        for stem in ("00_string_on_an_obstacle", "01_domain", "02_meshes", "03_by_hand", "06_p1_unstructured", "25_beam"):
            with self.subTest(stem=stem):
                here, page = self.both([stem])
                self.assertEqual((page[0], verdicts(page[1])), (here[0], verdicts(here[1])), page[2])

    def test_no_chapter_takes_200_mib(self):
        """What the pages say of it; that it is so is seen for the largest one that takes a moment."""
        said = {command: int(row["MiB"]) for command, row in ROWS.items() if row["MiB"]}
        self.assertEqual(sorted(said), [command[0] for command in commands() if len(command) == 1])
        self.assertLess(max(said.values()), 200)
        self.assertAlmostEqual(self.page(["04_reference_solution"])[3], said["04_reference_solution"], delta=4)

    def test_refusals_are_the_same_line(self):
        for command in (["08_crouzeix_raviart", "--cells", "9999"], ["08_crouzeix_raviart", "--sells", "8"], ["03_by_hand", "--epsilon", "2"]):
            with self.subTest(command=command):
                here, page = self.both(command)
                self.assertEqual(page[0:3:2], here[0:3:2])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]], verbosity=2)
