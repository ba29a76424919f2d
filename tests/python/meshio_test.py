"""meshio reads what run_scene writes: #1370 ("Illegal data type 'String'"), #786 (raw appended data), #1066.

The arrays stand in the XML, each in base64 of its own: meshio turns raw bytes behind the XML into one text in base64,
which Python 3.13 does not decode from the middle."""
import os
import subprocess

import numpy as np
import pytest

meshio = pytest.importorskip("meshio", reason="Debian: python3-meshio (.ci/install python)")

LAYER = '[load]\nf = "10*sin(2*pi*x)"\n[layer]\nepsilon = 1e-3\n[contact]\n'
RUBBER = '[load]\nf = "0"\n[contact]\ngap = "(x - 0.5)^2"\n[model]\nkind = "plane strain"\npush = 0.1\n'
MESH = '[mesh]\nkind = "structured"\ncells = {}\n[method]\nelement = "{}"\n'


# of several sizes, since the length of an array decides how its text in base64 ends
@pytest.mark.parametrize("cells", [2, 3, 4, 5])
@pytest.mark.parametrize("scene, element", [(LAYER, "P1"), (LAYER, "CR"), (LAYER, "P2"), (RUBBER, "CR")])
def test_meshio_reads_the_files_of_a_scene(tmp_path, scene, element, cells):
    triangles = 2 * cells**2 * (2 if scene is LAYER else 1)
    path = tmp_path / "scene.toml"
    path.write_text(scene + MESH.format(cells, element))
    subprocess.run([os.environ["RUN_SCENE"], path, "--out", tmp_path / "out"], check=True, capture_output=True)
    grid, mesh = meshio.read(tmp_path / "out/solution.vtu"), meshio.read(tmp_path / "out/mesh.msh")
    assert [(block.type, len(block.data)) for block in grid.cells] == [("triangle", triangles)]
    assert sum(len(block.data) for block in mesh.cells if block.type == "triangle") == triangles
    corners = grid.points[grid.cells[0].data][:, :, :2]
    edges = corners[:, 1:] - corners[:, :1]
    area = (edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]) / 2
    if scene is RUBBER:
        assert grid.point_data["displacement"].shape == (len(grid.points), 3)
        assert len(grid.cell_data["pressure"][0]) == triangles
        return
    assert area.sum() == pytest.approx(2, abs=1e-12)  # body and layer: numbers come through the bytes as they are
    region = grid.cell_data["region"][0].ravel()
    for name, number in (("body", 1), ("layer", 2)):
        assert int(grid.field_data[name].item()) == number
        assert area[region == number].sum() == pytest.approx(1, abs=1e-12)
    table = np.loadtxt(tmp_path / "out/solution.csv", delimiter=",", skiprows=1)
    if element != "CR":  # 17 digits: the same doubles; P2 is shown at its vertices, the first rows
        assert np.array_equal(grid.point_data["u"].ravel(), table[:len(grid.points), 2])
