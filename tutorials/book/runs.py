#!/usr/bin/python3
"""What the commands of the pages cost and ask for, as wasm/measure noted it in wasm/runs.csv. Run: runs.py
prints the names of all meshes that the pages hold."""
import csv
import re
from pathlib import Path

from literate import SETTINGS


def rows():
    return list(csv.DictReader((Path(__file__).parent / "wasm/runs.csv").open()))


def expected():
    """By command: how long it takes in a page, in words, and its memory, where that is known. A page takes about twice the
    processor seconds of the machine; what took it over ten minutes was not waited for."""
    def words(seconds):
        return "a moment" if seconds < 0.5 else "about a second" if seconds < 1.5 else f"about {float(f'{seconds:.1g}' if seconds > 20 else f'{seconds:.0f}'):.0f} s"
    return {row["command"]: (words(2 * float(row["seconds"])) if row["seconds"] else "minutes") +
            (f", {row['MiB']} MiB" if row["MiB"] else "") for row in rows()}


def live_meshes():
    """Those of the first page's figure, its layer of any triangles or in columns below the body's."""
    def number(x):  # as the library writes it
        return re.sub(r"\.?0*p", "p", float(x).hex())
    sizes = [number(1 / int(cells)) for cells in SETTINGS["locking"]["cells"].split("|")]
    return [f"unstructured6_{number(depth)}_{h}_{h}" for depth in (0, 1) for h in sizes]


def program_meshes():
    return sorted({name for row in rows() for name in row["meshes"].split()} - set(live_meshes()))


if __name__ == "__main__":
    print("\n".join([*live_meshes(), *program_meshes()]))
